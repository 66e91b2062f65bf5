#include "scene/gltf_mesh.h"

#include <algorithm>
#include <array>
#include <utility>

namespace facemap {

namespace {

using Cause = LoadError::Cause;

const Corners kNoCorners = {kNoIndex, kNoIndex, kNoIndex};
const Vector kWhite(1);

bool is_finite(const Vector& v) { return (v.x - v.x) + (v.y - v.y) + (v.z - v.z) == 0; }

Corners turned(const Corners& corners) { return {corners[0], corners[2], corners[1]}; }

}  // namespace

GltfMeshBuilder::GltfMeshBuilder(const GltfFile& file, GltfAccessors& accessors, GltfSurfaces& surfaces,
                                 const std::vector<GltfNode>& nodes, Model& model)
    : file_(file),
      accessors_(accessors),
      surfaces_(surfaces),
      skins_(file, accessors, nodes),
      model_(model),
      mesh_(model.mesh) {
  for (const GltfNode& node : nodes) {
    if (const auto index = node.value.find("mesh")) ++meshes_[index->as_index()].uses;
  }
}

void GltfMeshBuilder::add(const GltfNode& node) {
  const std::optional<GltfValue> index = node.value.find("mesh");
  if (!index) return;
  const GltfValue value = file_.root.element("meshes", index->as_index(), *index);
  KeptMesh& mesh = meshes_.at(index->as_index());
  if (!mesh.is_read) read(mesh, value);
  if (mesh.surfaces.empty()) return;
  const auto object = static_cast<std::uint32_t>(model_.objects.size());
  model_.objects.push_back(node.value.text("name", value.text("name", node.value.path())));
  const bool has_skin = node.value.find("skin").has_value();
  for (const Affine& world : instances(node)) {
    for (const GltfSurface& surface : mesh.surfaces) {
      if (has_skin && !surface.joints.empty()) {
        add_surface(node, Affine(), skins_.pose(node, surface), object);
      } else {
        add_surface(node, world, surface, object);
      }
    }
  }
  if (--mesh.uses == 0) mesh.surfaces = {};
}

void GltfMeshBuilder::read(KeptMesh& mesh, const GltfValue& value) {
  mesh.is_read = true;
  std::uint64_t face_count = 0;
  for (const GltfValue& primitive : value.elements("primitives")) {
    GltfSurface surface = surfaces_.read(primitive);
    face_count += surface.triangles.size();
    if (face_count > file_.limits.max_faces) {
      value.fail(Cause::TooLarge, "more than " + std::to_string(file_.limits.max_faces) + " triangles");
    }
    if (!surface.triangles.empty()) mesh.surfaces.push_back(std::move(surface));
  }
}

/// Where the node's mesh stands: at the node, or at places beside it that three accessors list.
std::vector<Affine> GltfMeshBuilder::instances(const GltfNode& node) {
  const std::optional<GltfValue> extension = node.value.extension("EXT_mesh_gpu_instancing");
  if (!extension || node.value.find("skin")) return {node.world};
  struct Attribute {
    const char* name;
    int components;
    const GltfAccessor* accessor = nullptr;
  };
  std::array<Attribute, 3> attributes = {{{"TRANSLATION", 3}, {"ROTATION", 4}, {"SCALE", 3}}};
  const GltfValue holder = extension->at("attributes");
  std::uint32_t count = UINT32_MAX;
  for (Attribute& attribute : attributes) {
    const std::optional<GltfValue> index = holder.find(attribute.name);
    if (!index) continue;
    attribute.accessor = &accessors_.open(index->as_index(), *index);
    if (attribute.accessor->components() != attribute.components) index->fail(Cause::BadValue, "is of another type");
    count = std::min(count, attribute.accessor->count());
  }
  if (count == UINT32_MAX) return {node.world};
  std::vector<Affine> result;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto [translation, rotation, scale] = attributes;
    const auto number = [i](const Attribute& attribute, int component, double otherwise) {
      return attribute.accessor == nullptr ? otherwise : attribute.accessor->number(i, component);
    };
    const DVector t(number(translation, 0, 0), number(translation, 1, 0), number(translation, 2, 0));
    const DVector s(number(scale, 0, 1), number(scale, 1, 1), number(scale, 2, 1));
    const Affine r =
        rotation_of({number(rotation, 0, 0), number(rotation, 1, 0), number(rotation, 2, 0), number(rotation, 3, 1)});
    result.push_back(node.world * compose(t, r, s));
  }
  return result;
}

void GltfMeshBuilder::add_surface(const GltfNode& node, const Affine& world, const GltfSurface& surface,
                                  std::uint32_t object) {
  check_room(node, surface);
  const std::size_t first_face = mesh_.face_count(), first_position = mesh_.positions.size();
  add_positions(node, world, surface);
  add_corners(mesh_.triangles, first_face, first_position, world, surface);
  if (!surface.normals.empty()) {
    add_corners(mesh_.normal_corners, first_face, mesh_.normals.size(), world, surface);
    add_normals(world, surface);
  }
  if (!surface.texture_coordinates.empty()) {
    add_corners(mesh_.texture_corners, first_face, mesh_.texture_coordinates.size(), world, surface);
    mesh_.texture_coordinates.insert(mesh_.texture_coordinates.end(), surface.texture_coordinates.begin(),
                                     surface.texture_coordinates.end());
  }
  if (!surface.colours.empty()) {
    mesh_.colours.resize(first_position, kWhite);
    mesh_.colours.insert(mesh_.colours.end(), surface.colours.begin(), surface.colours.end());
  }
  mesh_.triangle_materials.resize(mesh_.face_count(), surface.material);
  model_.triangle_objects.resize(mesh_.face_count(), object);
}

/// Every face has three vertices at most that no other face has: the limit of faces bounds all.
void GltfMeshBuilder::check_room(const GltfNode& node, const GltfSurface& surface) const {
  const std::uint64_t most_faces = std::min<std::uint64_t>(file_.limits.max_faces, INT32_MAX);
  if (surface.triangles.size() > most_faces - mesh_.face_count()) {
    node.value.fail(Cause::TooLarge, "more than " + std::to_string(most_faces) + " triangles");
  }
  if (surface.positions.size() >= kNoIndex - mesh_.positions.size()) {
    node.value.fail(Cause::TooLarge, "more than 2^32 - 2 vertices");
  }
}

void GltfMeshBuilder::add_positions(const GltfNode& node, const Affine& world, const GltfSurface& surface) {
  const std::size_t first = mesh_.positions.size();
  mesh_.positions.resize(first + surface.positions.size());
  for (std::size_t i = 0; i < surface.positions.size(); ++i) {
    const Vector placed(world.point(surface.positions[i]));
    if (!is_finite(placed)) node.value.fail(Cause::BadNumber, "moves a vertex to where no float goes");
    mesh_.positions[first + i] = placed;
  }
}

void GltfMeshBuilder::add_normals(const Affine& world, const GltfSurface& surface) {
  const Affine transform = world.of_normals();
  const std::size_t first = mesh_.normals.size();
  mesh_.normals.resize(first + surface.normals.size());
  for (std::size_t i = 0; i < surface.normals.size(); ++i) {
    mesh_.normals[first + i] = Vector(unit_or_zero(transform.direction(DVector(surface.normals[i]))));
  }
}

/// `corners` has entries for the faces before `face_count`, or for fewer: those have none. What a transform has
/// mirrored is turned, so that its front stays its front.
void GltfMeshBuilder::add_corners(std::vector<Corners>& corners, std::size_t face_count, std::size_t first,
                                  const Affine& world, const GltfSurface& surface) const {
  corners.resize(face_count, kNoCorners);
  corners.resize(face_count + surface.triangles.size());
  const bool is_mirrored = world.is_mirrored();
  const auto offset = static_cast<std::uint32_t>(first);
  for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
    const Corners& triangle = surface.triangles[i];
    const Corners moved = {triangle[0] + offset, triangle[1] + offset, triangle[2] + offset};
    corners[face_count + i] = is_mirrored ? turned(moved) : moved;
  }
}

void GltfMeshBuilder::finish() {
  if (!mesh_.normals.empty()) mesh_.normal_corners.resize(mesh_.face_count(), kNoCorners);
  if (!mesh_.texture_coordinates.empty()) mesh_.texture_corners.resize(mesh_.face_count(), kNoCorners);
  if (!mesh_.colours.empty()) mesh_.colours.resize(mesh_.positions.size(), kWhite);
  const auto& materials = mesh_.triangle_materials;
  if (std::all_of(materials.begin(), materials.end(), [](std::uint32_t material) { return material == kNoIndex; })) {
    mesh_.triangle_materials.clear();
  }
}

}  // namespace facemap
