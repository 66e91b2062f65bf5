#include <facemap/error.h>
#include <facemap/scene.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <string>
#include <utility>

#include "scene/odd_faces.h"
#include "simd/floating_point_mode.h"

namespace facemap {

namespace {

bool is_finite(const Vector& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check_indices(const std::vector<Corners>& corners, std::size_t limit, bool may_be_none, const char* what) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (const std::uint32_t index : corners[i]) {
      if (index < limit || (may_be_none && index == kNoIndex)) continue;
      throw Error("face " + std::to_string(i) + " refers to " + what + " " + std::to_string(index) + " of " +
                  std::to_string(limit));
    }
  }
}

/// An array that may be empty must otherwise have one value for each face (or position).
void check_size(std::size_t size, std::size_t wanted, const char* what) {
  if (size == 0 || size == wanted) return;
  throw Error(std::string(what) + ": " + std::to_string(size) + " values, not 0 or " + std::to_string(wanted));
}

void check(const Mesh& mesh, std::size_t material_count) {
  if (mesh.triangles.empty()) throw Error("a scene needs at least one face");
  if (mesh.triangles.size() > static_cast<std::size_t>(INT32_MAX)) throw Error("more than 2^31 - 1 faces");
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (!is_finite(mesh.positions[i])) throw Error("position " + std::to_string(i) + " is not finite");
  }
  check_size(mesh.colours.size(), mesh.positions.size(), "colours");
  check_size(mesh.normal_corners.size(), mesh.face_count(), "normal_corners");
  check_size(mesh.texture_corners.size(), mesh.face_count(), "texture_corners");
  check_size(mesh.polygons.size(), mesh.face_count(), "polygons");
  check_size(mesh.triangle_materials.size(), mesh.face_count(), "triangle_materials");
  check_indices(mesh.triangles, mesh.positions.size(), false, "position");
  check_indices(mesh.normal_corners, mesh.normals.size(), true, "normal");
  check_indices(mesh.texture_corners, mesh.texture_coordinates.size(), true, "texture coordinate");
  for (const std::uint32_t material : mesh.triangle_materials) {
    if (material != kNoIndex && material >= material_count) {
      throw Error("material " + std::to_string(material) + " of " + std::to_string(material_count));
    }
  }
}

/// The lower-case extension of a file's name, with its point.
std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace

Scene::Scene(Mesh mesh, std::vector<Material> materials) : mesh_(std::move(mesh)), materials_(std::move(materials)) {
  const FloatingPointMode mode;
  check(mesh_, materials_.size());
  odd_ = find_odd_faces(mesh_, kept_);
  kept_faces_.reserve(face_count());
  for (std::uint32_t face = 0; face < face_count(); ++face) {
    if (is_kept(face)) kept_faces_.push_back(face);
  }
  find_bounds();
}

Scene Scene::load(const std::filesystem::path& path) {
  if (extension_of(path) != ".obj") {
    throw LoadError(LoadError::Cause::UnknownFormat, path.string(), 0, "unknown format; known: .obj");
  }
  OBJ obj = OBJ::load(path);
  OBJ::Report report = obj.report();
  std::vector<Material> materials = obj.materials();
  Scene scene(std::move(obj).mesh(), std::move(materials));
  scene.report_ = std::move(report);
  return scene;
}

void Scene::find_bounds() {
  const auto for_each_vertex = [this](auto&& visit) {
    for (const std::uint32_t face : kept_faces_) {
      for (int corner = 0; corner < 3; ++corner) visit(mesh_.vertex(face, corner));
    }
    if (kept_faces_.empty()) std::for_each(mesh_.positions.begin(), mesh_.positions.end(), visit);
  };
  lower_ = upper_ = mesh_.vertex(kept_faces_.empty() ? 0 : kept_faces_[0], 0);
  for_each_vertex([this](const Vector& v) {
    lower_ = glm::min(lower_, v);
    upper_ = glm::max(upper_, v);
  });
  centre_ = (DVector(lower_) + DVector(upper_)) * 0.5;

  double farthest = 0;  // squared
  for_each_vertex([&](const Vector& v) {
    const DVector d = DVector(v) - centre_;
    farthest = std::max(farthest, d.x * d.x + d.y * d.y + d.z * d.z);
  });
  bounding_radius_ = std::sqrt(farthest);
}

}  // namespace facemap
