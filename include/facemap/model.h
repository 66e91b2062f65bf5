#pragma once

#include <facemap/light.h>
#include <facemap/material.h>
#include <facemap/mesh.h>
#include <facemap/texture.h>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace facemap {

/// A camera that stands in a model's file.
struct ModelCamera {
  std::string name;
  Vector position{0};
  Vector look_at{0, 0, -1};
  Vector up{0, 1, 0};
  bool is_parallel = false;                  ///< orthographic
  double field_angle = 0.87266462599716477;  ///< radians, full and vertical; of a perspective camera
  double height = 2;                         ///< world units that a picture shows, bottom to top; of a parallel one
};

/// All that a model's file holds: what every reader gives.
struct Model {
  Mesh mesh;  ///< instances are repeated, in world coordinates
  std::vector<Material> materials;
  std::vector<TextureImage> images;
  std::vector<Light> lights;
  std::vector<ModelCamera> cameras;
  std::vector<std::string> objects;             ///< names
  std::vector<std::uint32_t> triangle_objects;  ///< one a triangle into `objects`, or empty
  std::optional<Vector> up;                     ///< if the file's format states it
  std::vector<std::string> warnings;            ///< "file:line: text" or "file: text", one a cause
};

/// Limits of what reading may take; the first two are for files that are not to be trusted.
struct ModelLimits {
  std::uint64_t max_bytes = std::uint64_t{1} << 36;  ///< of the file, and of all that it names
  std::uint64_t max_faces = 0x7fffffff;              ///< triangles; a face id is an int32
  int threads = 0;                                   ///< that may read; 0: as many as the process may run at once
  bool allow_outside = false;                        ///< files that it names may lie outside its folder
};

}  // namespace facemap
