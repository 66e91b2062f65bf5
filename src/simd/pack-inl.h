// Lanes that are wanted, stored side by side. Included once a target, as foreach_target.h has it.
#include <array>
#include <cstddef>
#include <cstdint>

#if defined(FACEMAP_SIMD_PACK) == defined(HWY_TARGET_TOGGLE)
#ifdef FACEMAP_SIMD_PACK
#undef FACEMAP_SIMD_PACK
#else
#define FACEMAP_SIMD_PACK
#endif

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace facemap::simd::HWY_NAMESPACE {
namespace {

#if HWY_TARGET == HWY_AVX2 || HWY_TARGET == HWY_SSE4

// Highway 1.0.3 copies such a table at each call of Compress. Of eight lanes or fewer: those whose bits are set in a
// mask, then the others.
constexpr std::array<std::array<std::uint8_t, 8>, 256> packed_lanes() {
  std::array<std::array<std::uint8_t, 8>, 256> table{};
  for (std::size_t mask = 0; mask < 256; ++mask) {
    std::size_t place = 0;
    for (const std::size_t wanted : {1, 0}) {
      for (std::size_t lane = 0; lane < 8; ++lane) {
        if ((mask >> lane & 1) == wanted) table[mask][place++] = static_cast<std::uint8_t>(lane);
      }
    }
  }
  return table;
}
alignas(64) constexpr auto kPackedLanes = packed_lanes();

// Of vectors of 32-bit lanes.
template <class D>
class Packer {
 public:
  HWY_INLINE explicit Packer(hwy::HWY_NAMESPACE::Mask<D> wanted) : count_(hwy::HWY_NAMESPACE::CountTrue(D(), wanted)) {
    namespace hn = hwy::HWY_NAMESPACE;
    std::uint8_t bits[8];
    hn::StoreMaskBits(D(), wanted, bits);
    const hn::Rebind<std::uint8_t, D> bytes;
    lanes_ = hn::PromoteTo(Integers(), hn::LoadU(bytes, kPackedLanes[bits[0]].data()));
  }

  /// Stores a whole vector: what follows the wanted lanes is of no meaning.
  template <class V, class Value>
  HWY_INLINE void store(V v, Value* out) const {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::Rebind<Value, D> d;
    hn::StoreU(hn::TableLookupLanes(v, hn::IndicesFromVec(d, lanes_)), d, out);
  }
  HWY_INLINE std::size_t count() const { return count_; }

 private:
  using Integers = hwy::HWY_NAMESPACE::RebindToSigned<D>;

  std::size_t count_;
  hwy::HWY_NAMESPACE::Vec<Integers> lanes_;
};

#else

template <class D>
class Packer {
 public:
  HWY_INLINE explicit Packer(hwy::HWY_NAMESPACE::Mask<D> wanted) : wanted_(wanted) {}

  template <class V, class Value>
  HWY_INLINE void store(V v, Value* out) const {
    namespace hn = hwy::HWY_NAMESPACE;
    const hn::Rebind<Value, D> d;
    hn::StoreU(hn::Compress(v, hn::RebindMask(d, wanted_)), d, out);
  }
  HWY_INLINE std::size_t count() const { return hwy::HWY_NAMESPACE::CountTrue(D(), wanted_); }

 private:
  hwy::HWY_NAMESPACE::Mask<D> wanted_;
};

#endif

}  // namespace
}  // namespace facemap::simd::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif
