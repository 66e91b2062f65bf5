#pragma once

#include <facemap/face.h>
#include <facemap/material.h>
#include <facemap/mesh.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace facemap {

struct ObjModel;

/// A Wavefront OBJ file. Wang 2022, sec. 4.3: the OBJ class, which loads a model file and turns it into faces.
///
/// Numbers are the nearest floats to the decimals. Faces may name corners in every form (v, v/t, v//n, v/t/n), by
/// negative indices, and ahead of what they name. Polygons of any size are cut into triangles by ear clipping with
/// exact signs. Corners without a normal in a smoothing group get the area-weighted one of their group. A colour
/// behind a position is clamped to 0..1; vertices without one are white if any has one.
/// Refused, with the line: numbers that are none, not finite or too large for a float; indices that are 0 or out
/// of range; statements cut short; text with NUL bytes (UTF-16); files without a face.
class OBJ {
 public:
  /// A statement that was read over: its keyword, how often, and the line (from 1) where it first stood.
  struct Ignored {
    std::string statement;
    std::int64_t count = 0;
    std::int64_t first_line = 0;
  };

  /// What stood in the file.
  struct Report {
    std::int64_t vertices = 0;                    ///< v
    std::int64_t texture_coordinates = 0;         ///< vt
    std::int64_t normals = 0;                     ///< vn
    std::int64_t polygons = 0;                    ///< f, as in the file
    std::int64_t triangles = 0;                   ///< after triangulation
    std::int64_t objects = 0;                     ///< o
    std::int64_t groups = 0;                      ///< g
    std::int64_t self_intersecting_polygons = 0;  ///< turned into fans
    std::vector<Ignored> ignored;                 ///< l, p, free-form and unknown statements, in order of first sight
    std::vector<std::string> warnings;            ///< "file:line: text", one a cause
  };

  /// Limits of what reading may take; the first two are for files that are not to be trusted.
  struct Limits {
    std::uint64_t max_bytes = std::uint64_t{1} << 36;
    std::uint64_t max_faces = 0x7fffffff;  ///< triangles; a face id is an int32
    int threads = 0;                       ///< that may read; 0: as many as the process may run at once
    bool allow_outside = false;            ///< textures may lie outside the model's folder
  };

  /// Reads `path` and the MTL files that it names (beside it; an absent or broken one is a warning).
  /// Throws LoadError.
  static OBJ load(const std::filesystem::path& path) { return load(path, Limits()); }
  static OBJ load(const std::filesystem::path& path, const Limits& limits);

  /// Reads OBJ text from memory; `name` stands in messages for the file. MTL files are looked up in
  /// `directory`, or nowhere if it is empty. Throws LoadError.
  static OBJ parse(std::string_view text, const std::string& name, const std::filesystem::path& directory,
                   const Limits& limits);

  const Mesh& mesh() const& noexcept { return mesh_; }
  Mesh&& mesh() && noexcept { return std::move(mesh_); }
  const std::vector<Material>& materials() const noexcept { return materials_; }
  const std::vector<TextureImage>& images() const noexcept { return images_; }
  const Report& report() const noexcept { return report_; }

  /// All faces by value, in order of their id.
  std::vector<Face> faces() const;

 private:
  explicit OBJ(ObjModel&& model);

  Mesh mesh_;
  std::vector<Material> materials_;
  std::vector<TextureImage> images_;
  Report report_;
};

}  // namespace facemap
