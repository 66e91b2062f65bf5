#pragma once

#include <facemap/affine.h>
#include <facemap/light.h>
#include <facemap/material.h>
#include <facemap/mesh.h>
#include <facemap/texture.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
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
  std::vector<std::uint32_t> triangle_objects;  ///< one a triangle into `objects` (kNoIndex: none), or empty
  std::optional<Vector> up;                     ///< if the file's format states it; STL: z, by custom
  std::vector<std::string> warnings;            ///< "file:line: text" or "file: text", one a cause
};

/// Limits of what reading may take; the first two are for files that are not to be trusted.
struct ModelLimits {
  std::uint64_t max_bytes = std::uint64_t{1} << 36;  ///< of the file, and of all that it names
  std::uint64_t max_faces = 0x7fffffff;              ///< triangles; a face id is an int32
  int threads = 0;                                   ///< that may read; 0: as many as the process may run at once
  bool allow_outside = false;                        ///< files that it names may lie outside its folder
};

/// Reads a model's file: OBJ, glTF, PLY or STL, by its content, or by its name where that does not say. Throws
/// LoadError.
Model load_model(const std::filesystem::path& path, const ModelLimits& limits = {});

/// The same of bytes in memory; `name` stands in messages for the file. Files that they name are looked up in
/// `directory`, or nowhere if it is empty.
Model parse_model(std::string_view bytes, const std::string& name, const std::filesystem::path& directory = {},
                  const ModelLimits& limits = {});

/// The model moved, turned, scaled or sheared: positions rounded once from doubles, normals by the inverse transposed,
/// of unit length. What is mirrored keeps its fronts: the order of corners is turned. Lights and cameras go along;
/// where the transform enlarges, by the mean of its three axes, lights that fall off shine farther, so that the same
/// picture is seen. Throws Error if the transform is not finite or flattens the model.
Model transformed(Model model, const Affine& transform);

/// Adds another model: its triangles come behind those of `model`, its materials, images and objects get the numbers
/// behind those that are there. The first model that states an up gives it. Throws Error if the sum is too large.
void append(Model& model, Model other);

/// The ball about the middle of the box of all vertices that triangles use.
struct BoundingBall {
  DVector centre{0};
  double radius = 0;
};
BoundingBall bounding_ball(const Mesh& mesh);

}  // namespace facemap
