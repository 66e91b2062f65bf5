#pragma once

#include <facemap/parallel_map.h>
#include <facemap/renderer.h>

#include "render/eye.h"

namespace facemap {

/// Looks along one direction: an orthographic camera. Rays begin on a plane just in front of the whole scene, so that
/// each face is met; each ray's origin is a float32 point and exact input from there on, as is the direction.
class ParallelEye final : public Eye {
 public:
  /// `view` must be orthographic; of the options the picture's size counts, and what is known of holes.
  ParallelEye(const Scene& scene, const View& view, const Renderer::Options& options);

  const Scene& scene() const override { return map_.scene(); }
  Ray ray(const MapPoint& place) const override;
  Camera::Hit nearest(const Ray& ray, Counters* counters) const override;
  RayBundle bundle(const Ray& ray, const MapPoint& place, double step, double distance) const override;
  bool has_lists() const override { return false; }
  std::span<const std::uint32_t> faces_at(int, int) const override { return {}; }

  /// How far in front of the camera's plane a ray begins: world units, below 0 behind it.
  double start(const Ray& ray) const;

  std::size_t memory_bytes() const { return map_.memory_bytes(); }

 private:
  SpaceVector frame_;
  ParallelMap map_;
  double half_width_, half_height_;  // pixels
  double pixel_;                     // world units
  double front_;                     // along the sight, of the plane that rays begin on
};

}  // namespace facemap
