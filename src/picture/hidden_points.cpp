#include "picture/hidden_points.h"

#include "map/face_planes.h"
#include "math/exact_sign.h"

namespace facemap {
namespace {

// A step is added to the error: then places are allowed for that lie beyond a face that a point touches, so that no
// such face is surely away from it.
AskedPoints with_room_behind(const AskedPoints& points, const std::vector<std::uint32_t>& numbers) {
  AskedPoints some;
  copy_points(points, numbers, 0, some);
  some.error += points.step;
  return some;
}

}  // namespace

std::vector<std::uint32_t> find_hidden_points(const Scene& scene, const Vector& camera, const AskedPoints& points,
                                              const MovedPoints& moved, ShadowScratch& scratch, Counters& counters) {
  const std::size_t count = moved.numbers.size();
  std::vector<std::uint8_t> seen(count, 1);
  const auto is_between_or_touched = [&](std::size_t k, std::uint32_t face, int face_side) {
    const Triangle triangle = triangle_of(scene, face);
    return side(triangle, moved.positions[k], &counters) == 0 ||
           blocks(triangle, face_side, camera, GivenPoint{moved.positions[k]}, &counters);
  };
  // The camera as if it were a light.
  clear_blocked(scene, camera, with_room_behind(points, moved.numbers), {seen.data(), seen.data(), 1, 0}, nullptr,
                is_between_or_touched, scratch, &counters);
  std::vector<std::uint32_t> hidden;
  for (std::size_t k = 0; k < count; ++k) {
    if (seen[k] == 0) hidden.push_back(moved.numbers[k]);
  }
  return hidden;
}

}  // namespace facemap
