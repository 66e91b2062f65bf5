#pragma once

#include <facemap/renderer.h>

#include <array>
#include <cstdint>

#include "material/material_table.h"

namespace facemap {

/// Whether the picture goes on smoothly from one face to another: they have a vertex in common, the same material
/// there, are seen from the same side, and their shading normals are the same at that vertex, or all over if the faces
/// are flat. Working memory of one thread.
class JoinedFaces {
 public:
  /// All must outlive it; `materials` may be null.
  JoinedFaces(const Scene& scene, const Vector& camera, Renderer::Normals normals, const MaterialTable* materials)
      : scene_(scene), camera_(camera), normals_(normals), materials_(materials) {}

  /// A face is joined to itself; kNoFace to nothing else.
  bool are_joined(FaceId a, FaceId b) { return a == b || (a != kNoFace && b != kNoFace && know(a, b)); }

 private:
  struct Entry {
    FaceId a = kNoFace, b = kNoFace;
    bool are_joined = false;
  };

  bool know(FaceId a, FaceId b);
  bool find(std::size_t a, std::size_t b) const;
  bool have_same_look(std::size_t a, std::size_t b) const;
  bool are_equal_at(std::size_t a, int corner, std::size_t b, int other) const;
  bool is_smooth(std::size_t face) const;

  const Scene& scene_;
  const Vector camera_;
  const Renderer::Normals normals_;
  const MaterialTable* materials_;
  std::array<Entry, 1024> known_;
};

}  // namespace facemap
