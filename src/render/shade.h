#pragma once

#include <facemap/renderer.h>

#include <cstdint>
#include <span>
#include <vector>

#include "map/light_lists.h"
#include "material/material_table.h"
#include "render/eye.h"
#include "render/light_sources.h"
#include "render/surroundings.h"

namespace facemap {

/// What one ray of a picture brings back.
struct Sample {
  Color color;
  FaceId face = kNoFace;
  std::vector<std::uint8_t> lights;  ///< as Image::lights, one pixel
};

/// White mode: albedo 1; radiance = ambient and sky light, and the sum over lights, in index order, of colour *
/// intensity * cos * share (render/light_sources.h). With materials each light is multiplied by what the surface sends
/// on (docs/materials.md).
class Shader {
 public:
  /// Lifts below this share of the face's largest coordinate are noise: normals and the lifted point are rounded to
  /// float32, half a unit of 2^-24 for each coordinate, sqrt(3) for three.
  static constexpr double kLeastLift = 0x1p-23;

  /// `lists`: one a light, none of them null.
  Shader(const Eye& eye, std::span<const simd::LightSource> lights, const ListsOfLights& lists,
         const Renderer::Options& options, Renderer::Statistics& statistics, const MaterialTable* materials = nullptr);

  /// The sample along the ray through a map point; writes over `sample`, whose memory is used again. `step`: to the
  /// next sample to the right and down, in pixels, which textures are filtered for.
  void shade(const MapPoint& point, double step, Sample& sample);

  /// The surface along the same ray, unshaded; false if there is none.
  bool see(const MapPoint& point, double step, SeenSurface& seen, SurfaceLook& look);

 private:
  struct Surface;
  SeenSurface seen_surface(const Surface& surface, const MapPoint& point, double step) const;
  Surface surface_at(const Eye::Ray& ray, const Camera::Hit& hit) const;
  bool is_lit(std::size_t light, const Surface& surface);
  template <class Add>
  void for_each_lit(const Surface& surface, Sample& sample, const Add& add);
  DVector white_radiance(const Surface& surface, Sample& sample);
  DVector material_radiance(const Surface& surface, const MapPoint& point, double step, Sample& sample);

  const Eye& eye_;
  std::span<const simd::LightSource> lights_;
  const ListsOfLights& lists_;
  const Renderer::Options& options_;
  Renderer::Statistics& statistics_;
  const MaterialTable* materials_;  // null: all is white
  Surroundings surroundings_;
  FaceFrame frame_;
};

}  // namespace facemap
