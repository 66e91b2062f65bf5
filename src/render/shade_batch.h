#pragma once

#include <facemap/color.h>
#include <facemap/scene.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "picture/asked_points.h"
#include "picture/face_slots.h"
#include "picture/ray_table.h"
#include "render/light_sources.h"
#include "render/lit_surface.h"
#include "render/neighbour_rays.h"
#include "simd/shade_points.h"

namespace facemap {

/// A point that the shadow terminator fix lifts, and the number of the seen point that it stands for.
struct MovedPoint {
  Vector position{0};
  std::uint32_t owner = 0;
};

/// What shading finds at the place that a sample sees.
struct ShadedSurface {
  std::uint32_t sample = 0;
  SeenSurface seen;
  SurfaceLook look;
};

/// Shades some points of a picture together: Shader::shade is the definition. Working memory of one thread.
class ShadeBatch {
 public:
  /// The scene and the rays must outlive it, as must the materials. Without them (null) all is white.
  ShadeBatch(const Scene& scene, const SampleGrid& grid, const RayTable& rays, bool smooth,
             const MaterialTable* materials);

  /// Takes the points from number `first` on, at most simd::kSeenBatch, up to `end`. Returns how many.
  std::size_t take(const AskedPoints& points, std::size_t first, std::size_t end);

  /// The same, but leaves out points of faces without a normal at each corner. Returns the first that has not been
  /// looked at.
  std::size_t take_smooth(const AskedPoints& points, std::size_t first, std::size_t end);

  /// Takes what these samples see, at most simd::kSeenBatch.
  void take(const std::uint32_t* samples, const std::uint32_t* faces, std::size_t count);

  /// Adds the moved points among those taken. Throws Error if one is not finite.
  void find_moved(std::vector<MovedPoint>& moved);

  /// For each point that find_moved added last, in that order: bits of the lights that can add to its radiance if
  /// nothing is between, `stride` bytes a point.
  void find_lights_of_moved(const std::vector<simd::LightSource>& lights, std::uint8_t* masks, std::size_t stride);

  /// Clears the bits of lights whose cone or range does not hold the point, in `stride` bytes for each point taken.
  void clear_unreached(const std::vector<simd::LightSource>& lights, std::uint8_t* masks, std::size_t stride);

  /// Clears the bits of lights that the shading normal of a point shaded is turned from, `stride` bytes a point.
  void keep_lights_before(const std::vector<simd::LightSource>& lights, std::uint8_t* masks, std::size_t stride);

  /// Radiance of all points taken, from what surrounds them and from the lights of each one's mask, `stride` bytes a
  /// point.
  void shade(const std::vector<simd::LightSource>& lights, const Surroundings& surroundings, const std::uint8_t* masks,
             std::size_t stride);
  void store_colors(std::span<Color> colors) const;  ///< to the places of their samples
  void store_in_order(Color* colors) const;

  /// For planes: calls see(surface) for each point taken.
  void for_each_surface(const std::function<void(const ShadedSurface&)>& see);

 private:
  void set_up();
  void set_up_rays();
  void set_up_faces();
  void set_normals();
  void find_surfaces(bool smooth);
  bool is_moved(std::size_t i, const Vector& position) const;
  void shade_white(const std::vector<simd::LightSource>& lights, const Surroundings& surroundings,
                   const std::uint8_t* masks, std::size_t stride);
  void shade_materials(const std::vector<simd::LightSource>& lights, const Surroundings& surroundings,
                       const std::uint8_t* masks, std::size_t stride);
  bool find_neighbours();
  SeenSurface seen_surface(std::size_t i, bool has_neighbours) const;

  const Scene& scene_;
  Vector camera_;
  const RayTable& table_;
  const MaterialTable* materials_;
  std::unique_ptr<NeighbourRays> neighbours_;  // if there are materials
  FaceFrame frame_;
  bool smooth_;               // if any face has normals
  bool some_smooth_ = false;  // of the faces taken, some may be smooth
  FaceSlots slots_;
  simd::RayBatch rays_;
  simd::ShadedFaces faces_{};
  Corners normal_corners_[simd::kSeenBatch];  // of the faces taken
  simd::ShadedPoints points_{};
  std::uint32_t numbers_[simd::kSeenBatch], samples_[simd::kSeenBatch], face_ids_[simd::kSeenBatch];
  std::uint32_t moved_places_[simd::kSeenBatch];  // in the batch, of the moved points
  std::size_t moved_count_ = 0;
  std::int64_t lit_[simd::kSeenBatch] = {};
};

}  // namespace facemap
