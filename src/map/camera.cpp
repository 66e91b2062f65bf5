#include <facemap/camera.h>

#include <cmath>
#include <utility>

#include "map/face_planes.h"
#include "map/map_faces.h"
#include "map/nearest_hit.h"
#include "map/ray_tests.h"
#include "map/texels.h"
#include "simd/floating_point_mode.h"

namespace facemap {

Camera::Camera(const Scene& scene, const SpaceVector& frame, const Options& options)
    : Camera(map_faces(scene, options.cut_outs, options.max_texture_pixels), frame, options) {}

Camera::Camera(const MapFaces& faces, const SpaceVector& frame, const Options& options)
    : FaceMap(faces, frame, Projection(options.projection, options.field_angle, options.width, options.height),
              options.builder, options.keep_all) {}

Camera::Camera(const MapFaces& faces, const SpaceVector& frame, const Projection& projection,
               std::shared_ptr<const FacePlanesTable> planes, bool keep_all)
    : FaceMap(faces, frame, projection, Builder::Cover, keep_all, std::move(planes)) {}

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
  const RayTests tests{scene(), planes(), position(), direction, counters};
  // Faces are met after a look at those listed beside them: some are surely behind others.
  struct Met {
    std::uint32_t id;
    bool strictly_inside;
    double low;
  };
  Met met[RayTests::kChunk];
  std::size_t met_count = 0;
  double nearest_high = HUGE_VAL;
  const auto meet = [&] {
    for (std::size_t i = 0; i < met_count; ++i) {
      if (!(met[i].low > nearest_high)) best.meet(met[i].id, planes().side(met[i].id), met[i].strictly_inside);
    }
    met_count = 0;
  };
  const auto ends = [&](std::uint32_t id) {
    meet();
    return planes().nearest(id) > best.reach() * planes().scale() * (1 + Texels::kDepthMargin);
  };
  // Calls is_there(id) for each face that is met.
  const auto meet_listed = [&](std::span<const std::uint32_t> ids, const auto& is_there) {
    tests.for_each_met(ids, ends, [&](std::uint32_t id, const Covering& covering) {
      if (!is_there(id)) return;
      const RayTests::Range range = tests.range_of(id);
      met[met_count++] = {id, covering.strictly_inside, range.low};
      if (range.high < nearest_high) nearest_high = range.high;
    });
    meet();
  };
  meet_listed(faces_at(texel.x, texel.y), [](std::uint32_t) { return true; });
  meet_listed(cut_outs_at(texel.x, texel.y),
              [&](std::uint32_t id) { return cut_outs().is_there(id, DVector(position()), DVector(direction)); });
}

SurfacePoint Camera::surface_point(const Vector& direction, const Hit& hit) const {
  return {position(), direction, triangle_of(scene(), static_cast<std::uint32_t>(hit.face)), hit.face, hit.side};
}

}  // namespace facemap
