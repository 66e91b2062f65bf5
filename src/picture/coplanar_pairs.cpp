#include "picture/coplanar_pairs.h"

#include "map/face_planes.h"
#include "math/exact_sign.h"

namespace facemap {

bool CoplanarPairs::are_coplanar(std::uint32_t a, std::uint32_t b) {
  Entry& entry = entries_[(a * 0x9e3779b1u ^ b * 0x85ebca6bu) >> 24];
  if (entry.a == a && entry.b == b && a != b) return entry.are_coplanar;
  const Triangle first = triangle_of(scene_, a), second = triangle_of(scene_, b);
  entry = {a, b, side(first, second[0]) == 0 && side(first, second[1]) == 0 && side(first, second[2]) == 0};
  return entry.are_coplanar;
}

}  // namespace facemap
