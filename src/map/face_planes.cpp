#include "map/face_planes.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "math/dvector.h"
#include "math/power_of_two.h"
#include "scene/reserve_pages.h"
#include "simd/list_planes.h"

namespace facemap {
namespace {

// One pass of a radix sort, ascending by eleven bits and else in the order that was; `from` and `to` change places.
void sort_by_bits(std::vector<std::uint64_t>& from, int shift, std::vector<std::uint64_t>& to) {
  constexpr std::size_t kDigits = 1 << 11;
  std::array<std::size_t, kDigits + 1> next{};
  const auto digit = [shift](std::uint64_t key) { return (key >> shift) & (kDigits - 1); };
  for (const std::uint64_t key : from) ++next[digit(key) + 1];
  for (std::size_t i = 0; i < kDigits; ++i) next[i + 1] += next[i];
  for (const std::uint64_t key : from) to[next[digit(key)]++] = key;
  from.swap(to);
}

// Sixteen faces, of which the last ones may be the same.
void gather(const Mesh& mesh, const std::uint32_t* ids, std::size_t count, simd::SetupCorners& corners) {
  for (std::size_t i = 0; i < simd::kSetupFaces; ++i) {
    const std::uint32_t id = ids[std::min(i, count - 1)];
    for (int k = 0; k < 3; ++k) {
      const Vector& v = mesh.vertex(id, k);
      corners.of[k][0][i] = v.x;
      corners.of[k][1][i] = v.y;
      corners.of[k][2][i] = v.z;
    }
  }
}

}  // namespace

Triangle triangle_of(const Scene& scene, std::uint32_t face) {
  const Mesh& mesh = scene.mesh();
  return {mesh.vertex(face, 0), mesh.vertex(face, 1), mesh.vertex(face, 2)};
}

float float_below(double x) {
  const double lowered = x - std::fabs(x) * 0x1p-23 - 0x1p-149;  // denormal floats have no relative precision
  return std::clamp(static_cast<float>(lowered), -std::numeric_limits<float>::max(), std::numeric_limits<float>::max());
}

float float_above(double x) { return static_cast<float>(x + std::fabs(x) * 0x1p-23 + 0x1p-140); }

double distance_bound(double nearest_corner, double longest_edge) {
  constexpr double kRounding = 0x1p-48;  // of both squares, relative: the difference may cancel
  const double squared =
      nearest_corner * nearest_corner * (1 - kRounding) - longest_edge * longest_edge / 3 * (1 + kRounding);
  return squared > 0 ? std::sqrt(squared) : 0;
}

FacePlanesTable::FacePlanesTable(const Scene& scene, const Vector& origin) : sides_(scene.face_count()) {
  reserve_pages(planes_, scene.face_count());  // read in no order
  planes_.resize(scene.face_count());
  const double farthest = length(scene.centre() - DVector(origin)) + scene.bounding_radius();
  scale_ = inverse_power_of_two(farthest);

  const float O[3] = {origin.x, origin.y, origin.z};
  const std::vector<std::uint32_t>& ids = scene.kept_faces();
  simd::SetupCorners corners;
  simd::SetupPlanes planes;
  for (std::size_t first = 0; first < ids.size(); first += simd::kSetupFaces) {
    const std::size_t count = std::min(simd::kSetupFaces, ids.size() - first);
    gather(scene.mesh(), ids.data() + first, count, corners);
    simd::set_up_list_planes(corners, O, scale_, planes);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t id = ids[first + i];
      const int s = planes.side[i] != 0 ? planes.side[i] : facemap::side(triangle_of(scene, id), origin);
      sides_[id] = static_cast<std::int8_t>(s);
      if (s != 0) store(planes, i, s, planes_[id]);
    }
  }
}

void FacePlanesTable::store(const simd::SetupPlanes& from, std::size_t i, int side, simd::FacePlanes& to) const {
  const auto sign = static_cast<float>(side);
  for (int k = 0; k < 4; ++k) {
    to.x[k] = from.x[k][i] * sign;
    to.y[k] = from.y[k][i] * sign;
    to.z[k] = from.z[k][i] * sign;
  }
  to.offset = from.offset[i] * sign;
  to.error = from.error[i];
  to.offset_error = from.offset_error[i];
  const double bound = std::max(distance_bound(from.nearest_corner[i], from.longest_edge[i]), from.plane_distance[i]);
  to.nearest = std::max(0.0f, float_below(bound * scale_));
}

std::vector<std::uint32_t> FacePlanesTable::front_to_back(const Scene& scene) const {
  std::vector<std::uint64_t> keys;  // bound, which is not negative, and id
  keys.reserve(scene.kept_faces().size());
  for (const std::uint32_t id : scene.kept_faces()) {
    if (side(id) != 0) keys.push_back(std::uint64_t{std::bit_cast<std::uint32_t>(nearest(id))} << 32 | id);
  }
  std::vector<std::uint64_t> sorted(keys.size());
  for (const int shift : {32, 43, 54}) sort_by_bits(keys, shift, sorted);
  std::vector<std::uint32_t> ids(keys.size());
  for (std::size_t i = 0; i < ids.size(); ++i) ids[i] = static_cast<std::uint32_t>(keys[i]);
  return ids;
}

std::size_t FacePlanesTable::memory_bytes() const noexcept {
  return sides_.size() * sizeof(std::int8_t) + planes_.size() * sizeof(simd::FacePlanes);
}

}  // namespace facemap
