#include "render/parallel_eye.h"

#include <algorithm>

#include "math/dvector.h"
#include "render/picture_frame.h"

namespace facemap {
namespace {

// The plane in front stands off by this share of the scene's radius, and of the coordinates' sizes there: rounding to
// float32 moves origins by 2^-24 of those. The way from the camera's place is found in double precision, which moves
// them by a few 2^-53 of the place's size.
constexpr double kClearance = 0x1p-10, kRounding = 0x1p-20, kRoundingOfPlace = 0x1p-48;

double size_of(const DVector& v) { return std::max({std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)}); }

// Just in front of the scene, wherever the camera is: far away float32 steps may be wider than pixels. `extent`: how
// far from the sight a ray of the picture may be, world units.
double front_of(const Scene& scene, const SpaceVector& frame, double extent) {
  const DVector position(frame.position()), centre = scene.centre();
  const double radius = scene.bounding_radius();
  const double nearest = dot(centre - position, frame.axis_z()) - radius;
  const double sizes = size_of(position + frame.axis_z() * nearest) + size_of(centre) + radius + extent;
  const double rounding = sizes * kRounding + size_of(position) * kRoundingOfPlace;
  return nearest - radius * kClearance - rounding;
}

ParallelMap::Options map_options(const Renderer::Options& options) {
  ParallelMap::Options wanted;
  wanted.cut_outs = options.materials;
  wanted.max_texture_pixels = options.max_texture_pixels;
  return wanted;
}

}  // namespace

ParallelEye::ParallelEye(const Scene& scene, const View& view, const Renderer::Options& options)
    : frame_(frame_of(view)),
      map_(scene, Vector(frame_.axis_z()), map_options(options)),
      half_width_(options.width * 0.5),
      half_height_(options.height * 0.5),
      pixel_(view.height / options.height),
      front_(front_of(scene, frame_, pixel_ * (half_width_ + half_height_))) {}

Eye::Ray ParallelEye::ray(const MapPoint& place) const {
  const DVector local((place.x - half_width_) * pixel_, (half_height_ - place.y) * pixel_, front_);
  return {Vector(DVector(frame_.position()) + frame_.world_from_local(local)), map_.direction()};
}

Camera::Hit ParallelEye::nearest(const Ray& ray, Counters* counters) const {
  Camera::Hit hit = map_.nearest(ray.origin, counters);
  if (hit) hit.depth = static_cast<float>(hit.depth + start(ray));
  return hit;
}

double ParallelEye::start(const Ray& ray) const {
  return dot(DVector(ray.origin) - DVector(frame_.position()), frame_.axis_z());
}

// What the face is `distance` directions away moves by as much as the origin, up to its slope: as if the direction
// moved by that share.
RayBundle ParallelEye::bundle(const Ray& ray, const MapPoint&, double step, double distance) const {
  const double way = step * pixel_ / distance;
  return {ray.direction, Vector(DVector(ray.direction) + frame_.axis_x() * way),
          Vector(DVector(ray.direction) - frame_.axis_y() * way)};
}

}  // namespace facemap
