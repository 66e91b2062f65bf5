#include "picture/face_pairs.h"

#include "map/face_planes.h"
#include "math/exact_sign.h"

namespace facemap {

bool FacePairs::is_clear(std::uint32_t F, std::uint32_t G, int side, Counters& counters) {
  // Multiplicative hashing: the upper bits of a product with an odd number near 2^64 / 1.618 (Knuth 1973, 6.4).
  const std::uint64_t key = static_cast<std::uint64_t>(F) << 32 | G;
  Entry& entry = entries_[key * 0x9e3779b97f4a7c15u >> (64 - kBits)];
  if (entry.F != F || entry.G != G) entry = {F, G, find(F, G, side)};
  if (entry.answer == Answer::ClearByDouble) ++counters.by_double;
  if (entry.answer == Answer::ClearByExact) ++counters.by_exact;
  return entry.answer != Answer::Open;
}

FacePairs::Answer FacePairs::find(std::uint32_t F, std::uint32_t G, int side) const {
  Counters counters;
  if (reaches_beyond(triangle_of(scene_, F), triangle_of(scene_, G), side, &counters)) return Answer::Open;
  return counters.by_exact > 0 ? Answer::ClearByExact : Answer::ClearByDouble;
}

}  // namespace facemap
