#pragma once

#include <facemap/material.h>
#include <facemap/mesh.h>

#include <array>
#include <cstdint>
#include <vector>

namespace oracle {

/// The referee's own reading of docs/materials.md, "Holes": which faces are solid, which have holes, and whether one is
/// there where a line meets it. Images are decoded, and sines taken, as the library does it; the rest is its own.
class Holes {
 public:
  enum class Kind { Solid, CutOut, Gone };

  Holes(const facemap::Mesh& mesh, const std::vector<facemap::Material>& materials,
        const std::vector<facemap::TextureImage>& images);

  Kind kind(facemap::FaceId face) const;

  using Point = std::array<double, 3>;

  /// Whether a face that is cut out is there where the line from p along d meets its plane.
  bool is_there(facemap::FaceId face, const Point& p, const Point& d) const;

  /// Where the line from p along d meets the plane of three corners.
  static Point crossing(const std::array<facemap::Vector, 3>& corners, const Point& p, const Point& d);

 private:
  struct Surface {
    Kind kind = Kind::Solid, kind_without_places = Kind::Solid;  // of faces with texture coordinates and without
    facemap::TextureUse use;
    int width = 0, height = 0;
    std::vector<bool> there;  // rows from the top
  };

  const facemap::Mesh* mesh_;
  std::vector<Surface> surfaces_;
};

}  // namespace oracle
