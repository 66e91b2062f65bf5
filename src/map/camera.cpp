#include <facemap/camera.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "map/face_planes.h"
#include "map/texels.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

// Entries given to the filter at a time: a list is front to back, and most rays end within the first few.
constexpr std::size_t kChunk = 16;

// A direction scaled by a power of two to a length in [1, 4): exact, or off by less than the filter's underflow.
struct FilterDirection {
  float d[3];
  float length;  // upper bound

  explicit FilterDirection(const Vector& v) {
    const float largest = std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    const auto exponent = std::bit_cast<std::uint64_t>(static_cast<double>(largest)) >> 52;
    const double scale = std::bit_cast<double>((2046 - exponent) << 52);
    for (int i = 0; i < 3; ++i) d[i] = static_cast<float>(v[i] * scale);
    length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]) * (1 + 0x1p-20f);
  }
};

// The nearest of the faces met so far, by exact comparison.
class Nearest {
 public:
  Nearest(const Scene& scene, const Vector& O, const Vector& d, Counters* counters)
      : scene_(scene),
        O_(O),
        d_(d),
        length_(std::sqrt(double(d.x) * d.x + double(d.y) * d.y + double(d.z) * d.z)),
        counters_(counters) {}

  void meet(std::uint32_t id, int side, bool strictly_inside) {
    const Triangle face = triangle_of(scene_, id);
    const TruePoint point{O_, d_, face, side};
    const Tracked t = ray_parameter(point);
    const int order = hit_ ? compare(t, face, side) : -1;
    if (order == 0) {
      hit_.tied = true;
      // Wins: the face turned towards the camera, then the lower id.
      const bool wins = side != hit_.side ? side < hit_.side : static_cast<FaceId>(id) < hit_.face;
      if (!wins) return;
    } else if (order > 0) {
      return;
    } else {
      hit_.tied = false;
    }
    hit_.face = static_cast<FaceId>(id);
    hit_.side = side;
    hit_.strictly_inside = strictly_inside;
    t_ = t;
    face_ = face;
  }

  // Upper bound of the distance to the nearest hit, world units.
  double reach() const { return hit_ ? (t_.value + t_.error) * length_ * (1 + 0x1p-40) : HUGE_VAL; }

  Camera::Hit result() const {
    Camera::Hit hit = hit_;
    if (hit) hit.depth = static_cast<float>(sharp_ray_parameter({O_, d_, face_, hit.side}, t_) * length_);
    return hit;
  }

 private:
  // Sign of the new face's distance minus the best one's.
  int compare(const Tracked& t, const Triangle& face, int side) const {
    const int sign = (t - t_).sign();
    if (sign == 1 || sign == -1) return sign;
    return compare_depth(face, side, face_, hit_.side, O_, d_, counters_);
  }

  const Scene& scene_;
  Vector O_, d_;
  double length_;
  Counters* counters_;
  Camera::Hit hit_;
  Tracked t_;
  Triangle face_{};
};

}  // namespace

Camera::Camera(const Scene& scene, const SpaceVector& frame, const Options& options)
    : FaceMap(scene, frame, Projection(options.projection, options.field_angle, options.width, options.height),
              options.builder, options.keep_all) {}

Vector Camera::direction_through(const MapPoint& point) const {
  const FloatingPointMode mode;
  if (!projection().has_direction(point)) return Vector(0);
  return Vector(world_from_local(projection().local_from_map(point)));
}

Camera::Hit Camera::nearest(const Vector& direction, Counters* counters) const {
  const FloatingPointMode mode;
  const std::optional<Texel> texel = texel_of(DVector(direction));
  if (!texel) return {};  // nor for a direction that is zero or not finite
  const FilterDirection filter(direction);
  Nearest best(scene(), position(), direction, counters);
  const std::span<const std::uint32_t> ids = faces_at(texel->x, texel->y);
  simd::Verdict verdicts[kChunk];
  for (std::size_t first = 0; first < ids.size(); first += kChunk) {
    const std::size_t count = std::min(kChunk, ids.size() - first);
    const std::uint32_t* chunk = ids.data() + first;
    if (planes().nearest()[chunk[0]] > best.reach() * planes().scale() * (1 + Texels::kDepthMargin)) break;
    simd::cone_verdicts(planes().planes(), chunk, count, filter.d, filter.length, verdicts);
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t id = chunk[i];
      const int side = planes().side(id);
      if (verdicts[i] != simd::kUndecided && counters != nullptr) ++counters->by_float;
      if (verdicts[i] == simd::kNo) continue;
      if (verdicts[i] == simd::kYes) {
        best.meet(id, side, true);
        continue;
      }
      const Covering covering = covers(triangle_of(scene(), id), side, position(), direction, counters);
      if (covering.hit) best.meet(id, side, covering.strictly_inside);
    }
  }
  return best.result();
}

SurfacePoint Camera::surface_point(const Vector& direction, const Hit& hit) const {
  return {position(), direction, triangle_of(scene(), static_cast<std::uint32_t>(hit.face)), hit.face, hit.side};
}

}  // namespace facemap
