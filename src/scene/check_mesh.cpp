#include "scene/check_mesh.h"

#include <facemap/error.h>

#include <atomic>
#include <string>

namespace facemap {

namespace {

constexpr std::size_t kLeastPiece = 1 << 13;  ///< elements worth a task of their own

/// Throws by `complain(i)` for the first element of 0..count-1 that is not right; `all_right(first, last)` is quick.
template <class AllRight, class Complain>
void check_each(const Executor& executor, std::size_t count, const AllRight& all_right, const Complain& complain) {
  std::atomic<bool> is_right = true;
  for_ranges(executor, count, kLeastPiece, [&](std::size_t first, std::size_t last, int) {
    if (!all_right(first, last)) is_right = false;
  });
  for (std::size_t i = 0; i < count && !is_right; ++i) complain(i);
}

bool is_finite(const Vector& v) {
  // Not finite less itself is NaN.
  return (v.x - v.x) + (v.y - v.y) + (v.z - v.z) == 0;
}

void check_positions(const Executor& executor, const std::vector<Vector>& positions) {
  const auto all_finite = [&](std::size_t first, std::size_t last) {
    bool finite = true;  // without a branch for each
    for (std::size_t i = first; i != last; ++i) finite &= is_finite(positions[i]);
    return finite;
  };
  check_each(executor, positions.size(), all_finite, [&](std::size_t i) {
    if (!is_finite(positions[i])) throw Error("position " + std::to_string(i) + " is not finite");
  });
}

void check_indices(const Executor& executor, const std::vector<Corners>& corners, std::size_t limit, bool may_be_none,
                   const char* what) {
  const auto is_right = [=](std::uint32_t index) { return index < limit || (may_be_none && index == kNoIndex); };
  const auto all_right = [&](std::size_t first, std::size_t last) {
    bool right = true;
    for (std::size_t i = first; i != last; ++i) {
      for (const std::uint32_t index : corners[i]) right &= is_right(index);
    }
    return right;
  };
  check_each(executor, corners.size(), all_right, [&](std::size_t i) {
    for (const std::uint32_t index : corners[i]) {
      if (is_right(index)) continue;
      throw Error("face " + std::to_string(i) + " refers to " + what + " " + std::to_string(index) + " of " +
                  std::to_string(limit));
    }
  });
}

void check_materials(const Executor& executor, const std::vector<std::uint32_t>& materials, std::size_t limit) {
  const auto is_right = [=](std::uint32_t material) { return material < limit || material == kNoIndex; };
  const auto all_right = [&](std::size_t first, std::size_t last) {
    bool right = true;
    for (std::size_t i = first; i != last; ++i) right &= is_right(materials[i]);
    return right;
  };
  check_each(executor, materials.size(), all_right, [&](std::size_t i) {
    if (!is_right(materials[i]))
      throw Error("material " + std::to_string(materials[i]) + " of " + std::to_string(limit));
  });
}

/// An array that may be empty must otherwise have one value for each face (or position).
void check_size(std::size_t size, std::size_t wanted, const char* what) {
  if (size == 0 || size == wanted) return;
  throw Error(std::string(what) + ": " + std::to_string(size) + " values, not 0 or " + std::to_string(wanted));
}

}  // namespace

void check_mesh(const Mesh& mesh, std::size_t material_count, const Executor& executor) {
  if (mesh.triangles.empty()) throw Error("a scene needs at least one face");
  if (mesh.triangles.size() > static_cast<std::size_t>(INT32_MAX)) throw Error("more than 2^31 - 1 faces");
  check_positions(executor, mesh.positions);
  check_size(mesh.colours.size(), mesh.positions.size(), "colours");
  check_size(mesh.normal_corners.size(), mesh.face_count(), "normal_corners");
  check_size(mesh.texture_corners.size(), mesh.face_count(), "texture_corners");
  check_size(mesh.polygons.size(), mesh.face_count(), "polygons");
  check_size(mesh.triangle_materials.size(), mesh.face_count(), "triangle_materials");
  check_indices(executor, mesh.triangles, mesh.positions.size(), false, "position");
  check_indices(executor, mesh.normal_corners, mesh.normals.size(), true, "normal");
  check_indices(executor, mesh.texture_corners, mesh.texture_coordinates.size(), true, "texture coordinate");
  check_materials(executor, mesh.triangle_materials, material_count);
}

}  // namespace facemap
