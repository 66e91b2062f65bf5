#pragma once

#include <facemap/counters.h>
#include <facemap/scene.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <vector>

#include "picture/asked_points.h"

namespace facemap {

/// Working memory of clear_blocked, kept from light to light. One a thread.
class ShadowScratch {
 public:
  ShadowScratch();
  ~ShadowScratch();
  ShadowScratch(ShadowScratch&&) noexcept;
  ShadowScratch& operator=(ShadowScratch&&) noexcept;

  std::size_t memory_bytes() const noexcept;

  struct Parts;
  Parts& parts() noexcept { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

/// How many points ask about the light that most of them ask about. `asked`: stride bytes a point, one bit a light.
std::size_t most_asked(const std::vector<std::uint8_t>& asked, std::size_t stride);

/// Whether face `face`, whose side towards the light is `side`, stands strictly between the light and point `point`:
/// the exact answer, asked where the float32 filter leaves it open.
using BlocksExactly = std::function<bool(std::size_t point, std::uint32_t face, int side)>;

/// One bit of each point's mask: asked[point * stride + bit / 8], least significant first.
struct MaskBit {
  const std::uint8_t* asked;  ///< set: the point is asked
  std::uint8_t* lit;          ///< cleared where it is blocked; may be the same array
  std::size_t stride;         ///< bytes a point
  int bit;
  std::mutex* writing = nullptr;  ///< held while `lit` is written, if other lights write their bits at the same time
  std::size_t most = 0;           ///< no more points are asked than this, which other lights need too; 0: not known

  /// To be held while is_lit and clear are called.
  std::unique_lock<std::mutex> hold() const {
    return writing != nullptr ? std::unique_lock(*writing) : std::unique_lock<std::mutex>();
  }
  bool is_lit(std::size_t point) const { return (byte_of(point) >> (bit % 8) & 1) != 0; }
  void clear(std::size_t point) const {
    std::uint8_t& byte = byte_of(point);
    byte = static_cast<std::uint8_t>(byte & ~(1u << (bit % 8)));
  }

 private:
  std::uint8_t& byte_of(std::size_t point) const { return lit[point * stride + static_cast<std::size_t>(bit / 8)]; }
};

/// For every point whose bit is set in mask.asked: clears it in mask.lit if some kept face stands strictly between
/// `light` and the point. The transposed way: points are sorted into a raster about the light, then the faces run over
/// them; no list is made. `skip_entries` (one byte a face, or null): where it is not 0 the face may be left out if it
/// is turned towards the light (entry faces of closed parts). `some`, or null: no other faces stand between the light
/// and any of the points. Exact, whatever the order. Fewer than 2^31 points: kernels gather by signed 32-bit numbers.
void clear_blocked(const Scene& scene, const Vector& light, const AskedPoints& points, const MaskBit& mask,
                   const std::uint8_t* skip_entries, const BlocksExactly& blocks_exactly, ShadowScratch& scratch,
                   Counters* counters = nullptr, const std::vector<std::uint32_t>* some = nullptr);

}  // namespace facemap
