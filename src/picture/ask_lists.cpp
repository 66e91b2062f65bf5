#include "picture/ask_lists.h"

#include <algorithm>
#include <cmath>
#include <mutex>

#include "map/face_planes.h"
#include "math/dvector.h"
#include "math/exact_sign.h"
#include "picture/bytes_of.h"
#include "picture/near_face.h"

namespace facemap {
namespace {

// Of points that ask about a light: up to so many a face lists are quicker (measured at 2 and at 8), and up to so many
// in all there is nothing to gain.
constexpr std::size_t kMostPointsPerFace = 4, kFewPoints = std::size_t{1} << 14;

// What float32 leaves open doubles decide, and exact arithmetic the rest.
bool is_blocked_by(const Scene& scene, const Vector& light, const AskedPoints& points, const simd::OpenPair& pair,
                   const BlocksExactly& blocks_exactly, Counters& counters) {
  const Triangle corners = triangle_of(scene, pair.face);
  const int face_side = side(corners, light, &counters);
  if (face_side == 0) return false;
  const DVector D = place_of(points, pair.point) - DVector(light);
  const int verdict = verdict_on(near_face(pair.face, face_side, corners, light), D, error_of(points, pair.point));
  if (verdict == 0) return blocks_exactly(pair.point, pair.face, face_side);
  ++counters.by_double;
  return verdict > 0;
}

// Doubles decide almost all pairs of given points, many at a time; the others stay.
void decide_given(const Scene& scene, const Vector& light, const float* points, PointsOnLists& listed,
                  UnsetVector<std::uint8_t>& dark) {
  const Mesh& mesh = scene.mesh();
  const simd::GivenPoints given{points, mesh.triangles[0].data(), &mesh.positions[0].x, {light.x, light.y, light.z}};
  std::erase_if(listed.pairs, [&](const simd::GivenPair& pair) { return dark[pair.point] != 0; });
  listed.verdicts.resize(listed.pairs.size());
  simd::decide_pairs(given, listed.pairs.data(), listed.pairs.size(), listed.verdicts.data());
  std::size_t kept = 0;
  for (std::size_t k = 0; k < listed.pairs.size(); ++k) {
    if (listed.verdicts[k] == 1) dark[listed.pairs[k].point] = 1;
    if (listed.verdicts[k] == 2) listed.pairs[kept++] = listed.pairs[k];
  }
  listed.pairs.resize(kept);
}

}  // namespace

std::size_t PointsOnLists::memory_bytes() const noexcept {
  return bytes_of(numbers) + bytes_of(texels) + bytes_of(depths) + bytes_of(pairs) + bytes_of(verdicts);
}

bool can_ask_lists(const Scene& scene, const Vector& light, double size) {
  const DVector offset = DVector(scene.centre()) - DVector(light);
  const double from_light = std::max({std::fabs(offset.x), std::fabs(offset.y), std::fabs(offset.z)});
  return from_light >= simd::kLeastListedSize && from_light + scene.bounding_radius() <= simd::kGreatestListedSize &&
         size <= simd::kGreatestListedSize && scene.face_count() <= simd::kMostListed &&
         scene.mesh().positions.size() <= simd::kMostListed;
}

bool are_lists_quicker(std::size_t points, std::size_t faces) {
  return points <= std::max(kFewPoints, kMostPointsPerFace * faces);
}

std::size_t ask_lists(const Scene& scene, const Vector& light, const TexelLists& lists, const AskedPoints& points,
                      const MaskBit& mask, const BlocksExactly& blocks_exactly, PointsOnLists& listed,
                      UnsetVector<std::uint8_t>& dark, Counters& counters) {
  const Mesh& mesh = scene.mesh();
  const DVector offset = points.origin - DVector(light);
  const simd::FaceLists faces{
      lists.begins(),      lists.entries(),          lists.spots(),        lists.face_bits(),
      lists.depth_shift(), mesh.triangles[0].data(), &mesh.positions[0].x, {light.x, light.y, light.z}};
  const simd::PointsToList asked{points.x.data(),       points.y.data(),      points.z.data(),
                                 points.faces.data(),   points.step,          {offset.x, offset.y, offset.z},
                                 listed.numbers.data(), listed.texels.data(), listed.depths.data(),
                                 listed.numbers.size()};
  listed.pairs.clear();
  const std::uint64_t decided = simd::ask_lists(faces, asked, dark.data(), listed.pairs);
  counters.by_float += decided;
  const std::size_t held = static_cast<std::size_t>(decided) + listed.pairs.size();
  if (points.given != nullptr) decide_given(scene, light, points.given, listed, dark);
  for (const simd::OpenPair& pair : listed.pairs) {
    if (dark[pair.point] != 0) continue;
    dark[pair.point] = is_blocked_by(scene, light, points, pair, blocks_exactly, counters) ? 1 : 0;
  }
  const std::unique_lock lock = mask.hold();
  for (const std::uint32_t number : listed.numbers) {
    if (dark[number] != 0) mask.clear(number);
  }
  return held;
}

}  // namespace facemap
