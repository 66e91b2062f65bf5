#include "render/eye.h"

#include "render/neighbour_rays.h"

namespace facemap {

Eye::Ray CentralEye::ray(const MapPoint& place) const {
  const std::optional<DVector> local = lens_.direction(place);
  return {camera_.position(), local ? Vector(camera_.world_from_local(*local)) : Vector(0)};
}

Camera::Hit CentralEye::nearest(const Ray& ray, Counters* counters) const {
  return camera_.nearest(ray.direction, counters);
}

RayBundle CentralEye::bundle(const Ray& ray, const MapPoint& place, double step, double) const {
  RayBundle rays{ray.direction};
  set_neighbours(camera_, lens_, place, step, rays);
  return rays;
}

std::span<const std::uint32_t> CentralEye::faces_at(int x, int y) const {
  if (!has_lists()) return {};
  return camera_.faces_at(x, y);
}

std::span<const std::uint32_t> CentralEye::cut_outs_at(int x, int y) const {
  if (!has_lists()) return {};
  return camera_.cut_outs_at(x, y);
}

}  // namespace facemap
