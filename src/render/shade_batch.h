#pragma once

#include <facemap/color.h>
#include <facemap/scene.h>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "picture/asked_points.h"
#include "picture/face_slots.h"
#include "picture/ray_table.h"
#include "simd/shade_points.h"

namespace facemap {

/// A point that the shadow terminator fix lifts, and the number of the seen point that it stands for.
struct MovedPoint {
  Vector position{0};
  std::uint32_t owner = 0;
};

/// Shades some points of a picture together: Shader::shade is the definition. Working memory of one thread.
class ShadeBatch {
 public:
  /// The scene and the rays must outlive it.
  ShadeBatch(const Scene& scene, const Vector& camera, const RayTable& rays, bool smooth);

  /// Takes points first..first+count-1, at most simd::kSeenBatch.
  void take(const AskedPoints& points, std::size_t first, std::size_t count);

  /// Adds the moved points among them, with `first` as the number of the first point. Throws Error if one is not
  /// finite.
  void find_moved(std::size_t first, std::vector<MovedPoint>& moved);

  /// Makes the shading normals that may_add needs.
  void find_normals() { find_surfaces(smooth_); }

  /// After find_normals: whether the light can add to the radiance of point i if nothing is between.
  bool may_add(const simd::LightSource& light, std::size_t i) const;

  /// Radiance from the lights of each point's mask, `stride` bytes a point.
  void shade(const std::vector<simd::LightSource>& lights, bool inverse_square, const std::uint8_t* masks,
             std::size_t stride);
  void store_colors(const std::uint32_t* samples, std::span<Color> colors) const;

 private:
  void set_up_rays(const AskedPoints& points, std::size_t first);
  void set_up_faces();
  void find_surfaces(bool smooth);
  bool is_moved(std::size_t i, const Vector& position) const;

  const Scene& scene_;
  Vector camera_;
  const RayTable& table_;
  bool smooth_;
  FaceSlots slots_;
  simd::RayBatch rays_;
  simd::ShadedFaces faces_{};
  simd::ShadedPoints points_{};
  std::int64_t lit_[simd::kSeenBatch] = {};
};

}  // namespace facemap
