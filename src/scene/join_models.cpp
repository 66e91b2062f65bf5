#include <facemap/error.h>
#include <facemap/model.h>

#include <cstdint>
#include <string>
#include <utility>

namespace facemap {

namespace {

constexpr std::uint64_t kMostFaces = 0x7fffffff;  ///< a face id is an int32
constexpr std::uint64_t kMostIndices = kNoIndex;
constexpr Corners kNoCorners = {kNoIndex, kNoIndex, kNoIndex};

constexpr TextureUse Material::*kMaps[] = {
    &Material::diffuse_map,   &Material::opacity_map,  &Material::specular_map,
    &Material::shininess_map, &Material::emission_map, &Material::metallic_map,
    &Material::roughness_map, &Material::normal_map,   &Material::bump_map,
};

void check_sum(std::size_t a, std::size_t b, std::uint64_t most, const char* what) {
  if (a + b > most) throw Error("models together: more than " + std::to_string(most) + " " + what);
}

template <typename Value>
void move_behind(std::vector<Value>& values, std::vector<Value>& more) {
  if (values.empty()) {
    values = std::move(more);
  } else {
    values.insert(values.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  }
}

/// Joins arrays of which each is empty or has one value for each of `count` and `more_count` elements.
template <typename Value>
void join_optional(std::vector<Value>& values, std::size_t count, std::vector<Value>& more, std::size_t more_count,
                   const Value& none) {
  if (values.empty() && more.empty()) return;
  if (values.empty()) values.resize(count, none);
  if (more.empty()) more.resize(more_count, none);
  move_behind(values, more);
}

void renumber(std::vector<std::uint32_t>& indices, std::size_t first) {
  for (std::uint32_t& index : indices) {
    if (index != kNoIndex) index += static_cast<std::uint32_t>(first);
  }
}

void renumber(std::vector<Corners>& corners, std::size_t first) {
  for (Corners& triangle : corners) {
    for (std::uint32_t& index : triangle) {
      if (index != kNoIndex) index += static_cast<std::uint32_t>(first);
    }
  }
}

/// The file's faces of `mesh` by number, where they are not the triangles themselves.
void number_polygons(Mesh& mesh) {
  for (std::size_t i = mesh.polygons.size(); i < mesh.face_count(); ++i) {
    mesh.polygons.push_back(static_cast<std::uint32_t>(i));
  }
}

void join_polygons(Mesh& mesh, Mesh& other) {
  if (mesh.polygons.empty() && other.polygons.empty()) return;
  number_polygons(mesh);
  number_polygons(other);
  const std::size_t first = mesh.polygons.empty() ? 0 : mesh.polygons.back() + std::size_t{1};
  renumber(other.polygons, first);
  move_behind(mesh.polygons, other.polygons);
}

void join_meshes(Mesh& mesh, Mesh& other, std::size_t first_material) {
  const std::size_t faces = mesh.face_count(), more_faces = other.face_count();
  const std::size_t vertices = mesh.positions.size(), more_vertices = other.positions.size();
  check_sum(faces, more_faces, kMostFaces, "triangles");
  check_sum(vertices, more_vertices, kMostIndices, "vertices");
  check_sum(mesh.normals.size(), other.normals.size(), kMostIndices, "normals");
  check_sum(mesh.texture_coordinates.size(), other.texture_coordinates.size(), kMostIndices, "texture coordinates");
  renumber(other.triangles, vertices);
  renumber(other.normal_corners, mesh.normals.size());
  renumber(other.texture_corners, mesh.texture_coordinates.size());
  renumber(other.triangle_materials, first_material);
  join_polygons(mesh, other);
  join_optional(mesh.normal_corners, faces, other.normal_corners, more_faces, kNoCorners);
  join_optional(mesh.texture_corners, faces, other.texture_corners, more_faces, kNoCorners);
  join_optional(mesh.triangle_materials, faces, other.triangle_materials, more_faces, std::uint32_t{kNoIndex});
  join_optional(mesh.colours, vertices, other.colours, more_vertices, Vector(1));
  move_behind(mesh.triangles, other.triangles);
  move_behind(mesh.positions, other.positions);
  move_behind(mesh.normals, other.normals);
  move_behind(mesh.texture_coordinates, other.texture_coordinates);
}

}  // namespace

void append(Model& model, Model other) {
  for (Material& material : other.materials) {
    for (const auto map : kMaps) {
      if ((material.*map).is_used()) (material.*map).image += static_cast<std::uint32_t>(model.images.size());
    }
  }
  renumber(other.triangle_objects, model.objects.size());
  join_optional(model.triangle_objects, model.mesh.face_count(), other.triangle_objects, other.mesh.face_count(),
                std::uint32_t{kNoIndex});
  move_behind(model.objects, other.objects);
  join_meshes(model.mesh, other.mesh, model.materials.size());
  move_behind(model.materials, other.materials);
  move_behind(model.images, other.images);
  move_behind(model.lights, other.lights);
  move_behind(model.cameras, other.cameras);
  move_behind(model.warnings, other.warnings);
  if (!model.up) model.up = other.up;
}

}  // namespace facemap
