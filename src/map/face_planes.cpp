#include "map/face_planes.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "math/vec3.h"
#include "scene/reserve_pages.h"

namespace facemap {
namespace {

constexpr double kFloatHalfUlp = 0x1p-24;

// Roundings between a true edge product m . d and the computed one, in units of 2^-24 |m| |d|: m to float32 (1),
// d to float32 (1) and kDirectionError, three products and two sums (3). 6 leaves room for the rounding of the
// bound itself and for second-order terms.
constexpr double kDotRoundings = 6;

// The offset rounded to float32 (1) and the last subtraction (1, of a result that is at most |n . D| + offset).
constexpr double kOffsetRoundings = 3;

Vec3<Tracked> difference(const Vector& a, const Vector& b) {
  return {Tracked::difference(a.x, b.x), Tracked::difference(a.y, b.y), Tracked::difference(a.z, b.z)};
}

double length(const Vec3<Tracked>& v) {
  return std::sqrt(v.x.value * v.x.value + v.y.value * v.y.value + v.z.value * v.z.value);
}

double error_of(const Vec3<Tracked>& v) { return v.x.error + v.y.error + v.z.error; }

void store(const Vec3<Tracked>& v, double factor, int plane, simd::FacePlanes& planes) {
  planes.x[plane] = static_cast<float>(v.x.value * factor);
  planes.y[plane] = static_cast<float>(v.y.value * factor);
  planes.z[plane] = static_cast<float>(v.z.value * factor);
}

double power_of_two(int exponent) { return std::bit_cast<double>(static_cast<std::uint64_t>(exponent + 1023) << 52); }

// 2^-k for the k with 2^k <= x < 2^(k+1); 1 for 0.
double inverse_power_of_two(double x) {
  if (!(x > 0)) return 1;
  return power_of_two(1023 - static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52));
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

FacePlanesTable::FacePlanesTable(const Scene& scene, const Vector& origin)
    : sides_(scene.face_count()), nearest_(scene.face_count()) {
  reserve_pages(planes_, scene.face_count());  // read in no order
  planes_.resize(scene.face_count());
  double farthest = 0;
  for (const std::uint32_t id : scene.kept_faces()) {
    for (const Vector& v : triangle_of(scene, id)) farthest = std::max(farthest, length(difference(v, origin)));
  }
  scale_ = inverse_power_of_two(farthest);

  for (const std::uint32_t id : scene.kept_faces()) {
    const Triangle f = triangle_of(scene, id);
    const int s = facemap::side(f, origin);
    sides_[id] = static_cast<std::int8_t>(s);
    if (s == 0) continue;

    simd::FacePlanes& p = planes_[id];
    const double square = s * scale_ * scale_, area = scale_ * scale_;
    double largest_edge_error = 0, longest_edge = 0, nearest_corner = HUGE_VAL;
    for (int i = 0; i < 3; ++i) {
      const Vec3<Tracked> corner = difference(f[i], origin), along = difference(f[(i + 1) % 3], f[i]);
      const Vec3<Tracked> m = cross(corner, along);
      store(m, square, i, p);
      largest_edge_error = std::max(largest_edge_error, kDotRoundings * kFloatHalfUlp * length(m) + 2 * error_of(m));
      longest_edge = std::max(longest_edge, length(along));
      nearest_corner = std::min(nearest_corner, length(corner));
    }
    p.edge_error = float_above(largest_edge_error * area);

    const Vec3<Tracked> n = cross(difference(f[1], f[0]), difference(f[2], f[0]));
    const Tracked offset = dot(n, difference(f[0], origin));
    const double n_length = length(n), n_error = error_of(n);
    store(n, square, 3, p);
    p.offset = static_cast<float>(offset.value * square * scale_);
    p.normal_error = float_above((kDotRoundings * kFloatHalfUlp * n_length + 2 * n_error) * area);
    p.offset_error =
        float_above((kOffsetRoundings * kFloatHalfUlp * std::fabs(offset.value) + 2 * offset.error) * area * scale_);

    // The larger of the corners' bound and the plane's distance, less what rounding may have added to it.
    const double plane_distance = (std::fabs(offset.value) - 2 * offset.error) / (n_length + 2 * n_error);
    const double bound = std::max(distance_bound(nearest_corner, longest_edge), plane_distance);
    nearest_[id] = std::max(0.0f, float_below(bound * scale_));
  }
}

std::vector<std::uint32_t> FacePlanesTable::front_to_back(const Scene& scene) const {
  std::vector<std::uint32_t> ids;
  ids.reserve(scene.kept_faces().size());
  for (const std::uint32_t id : scene.kept_faces()) {
    if (side(id) != 0) ids.push_back(id);
  }
  std::sort(ids.begin(), ids.end(), [this](std::uint32_t a, std::uint32_t b) {
    return nearest_[a] != nearest_[b] ? nearest_[a] < nearest_[b] : a < b;
  });
  return ids;
}

std::size_t FacePlanesTable::memory_bytes() const noexcept {
  return sides_.size() * sizeof(std::int8_t) + planes_.size() * sizeof(simd::FacePlanes) +
         nearest_.size() * sizeof(float);
}

}  // namespace facemap
