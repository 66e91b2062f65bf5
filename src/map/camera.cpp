#include <facemap/camera.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "map/face_planes.h"
#include "map/map_faces.h"
#include "map/nearest_hit.h"
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

}  // namespace

Camera::Camera(const Scene& scene, const SpaceVector& frame, const Options& options)
    : Camera(map_faces(scene, options.cut_outs, options.max_texture_pixels), frame, options) {}

Camera::Camera(const MapFaces& faces, const SpaceVector& frame, const Options& options)
    : FaceMap(faces, frame, Projection(options.projection, options.field_angle, options.width, options.height),
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
  NearestHit best(scene(), position(), direction, counters);
  meet_faces(*texel, direction, best, counters);
  return best.with_depth();
}

void Camera::meet_faces(const Texel& texel, const Vector& direction, NearestHit& best, Counters* counters) const {
  const FilterDirection filter(direction);
  // Calls is_there(id) for each face that is met.
  const auto meet_listed = [&](std::span<const std::uint32_t> ids, const auto& is_there) {
    simd::Verdict verdicts[kChunk];
    for (std::size_t first = 0; first < ids.size(); first += kChunk) {
      const std::size_t count = std::min(kChunk, ids.size() - first);
      const std::uint32_t* chunk = ids.data() + first;
      if (planes().nearest(chunk[0]) > best.reach() * planes().scale() * (1 + Texels::kDepthMargin)) break;
      simd::cone_verdicts(planes().planes(), chunk, count, filter.d, filter.length, verdicts);
      for (std::size_t i = 0; i < count; ++i) {
        const std::uint32_t id = chunk[i];
        const int side = planes().side(id);
        if (verdicts[i] != simd::kUndecided && counters != nullptr) ++counters->by_float;
        if (verdicts[i] == simd::kNo) continue;
        Covering covering{true, true};
        if (verdicts[i] != simd::kYes)
          covering = covers(triangle_of(scene(), id), side, position(), direction, counters);
        if (covering.hit && is_there(id)) best.meet(id, side, covering.strictly_inside);
      }
    }
  };
  meet_listed(faces_at(texel.x, texel.y), [](std::uint32_t) { return true; });
  meet_listed(cut_outs_at(texel.x, texel.y),
              [&](std::uint32_t id) { return cut_outs().is_there(id, DVector(position()), DVector(direction)); });
}

SurfacePoint Camera::surface_point(const Vector& direction, const Hit& hit) const {
  return {position(), direction, triangle_of(scene(), static_cast<std::uint32_t>(hit.face)), hit.face, hit.side};
}

}  // namespace facemap
