#include "scene/gltf_surface.h"

#include <algorithm>
#include <string>

namespace facemap {

namespace {

using Cause = LoadError::Cause;

/// WebGL's numbers of what a list of corners means.
enum class Mode { Triangles = 4, Strip = 5, Fan = 6 };

/// A float, or 0 for what is infinite or none.
float finite_or_zero(double value) {
  const float rounded = static_cast<float>(value);
  return rounded - rounded == 0 ? rounded : 0.0f;
}

std::uint64_t triangle_count(Mode mode, std::uint64_t corners) {
  if (mode == Mode::Triangles) return corners / 3;
  return corners < 3 ? 0 : corners - 2;
}

/// The i-th triangle as places in the list of corners. Those of a strip turn the same way: every second one is turned.
Corners triangle(Mode mode, std::uint32_t i) {
  if (mode == Mode::Triangles) return {3 * i, 3 * i + 1, 3 * i + 2};
  if (mode == Mode::Strip) return {i, i + 1 + i % 2, i + 2 - i % 2};
  return {i + 1, i + 2, 0};
}

/// Corners of so many triangles.
std::uint64_t corner_count(Mode mode, std::uint64_t triangles) {
  if (mode == Mode::Triangles) return 3 * triangles;
  return triangles == 0 ? 0 : triangles + 2;
}

std::vector<Corners> list_triangles(Mode mode, std::uint32_t count, const std::vector<std::uint32_t>& corners) {
  std::vector<Corners> triangles(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    const Corners places = triangle(mode, i);
    triangles[i] = {corners[places[0]], corners[places[1]], corners[places[2]]};
  }
  return triangles;
}

/// None for points and lines.
std::optional<Mode> mode_of(const GltfValue& primitive) {
  const std::uint64_t mode = primitive.integer("mode", 4);
  if (mode > 6) primitive.at("mode").fail(Cause::BadValue, "is not one of 0 to 6");
  if (mode < 4) return std::nullopt;
  return static_cast<Mode>(mode);
}

DVector vector_at(const GltfAccessor& accessor, std::uint32_t i) {
  return {accessor.number(i, 0), accessor.number(i, 1), accessor.number(i, 2)};
}

std::vector<DVector> read_positions(const GltfAccessor& accessor, const std::vector<std::uint32_t>& vertices) {
  std::vector<DVector> result;
  result.reserve(vertices.size());
  for (const std::uint32_t vertex : vertices) {
    const DVector p = vector_at(accessor, vertex);
    if ((p.x - p.x) + (p.y - p.y) + (p.z - p.z) != 0) {
      accessor.fail(Cause::BadNumber, "position " + std::to_string(vertex) + " is not finite");
    }
    result.push_back(p);
  }
  return result;
}

std::vector<Vector> read_vectors(const GltfAccessor& accessor, const std::vector<std::uint32_t>& vertices) {
  std::vector<Vector> result;
  result.reserve(vertices.size());
  for (const std::uint32_t vertex : vertices) {
    const DVector v = vector_at(accessor, vertex);
    result.push_back({finite_or_zero(v.x), finite_or_zero(v.y), finite_or_zero(v.z)});
  }
  return result;
}

std::vector<glm::vec2> read_pairs(const GltfAccessor& accessor, const std::vector<std::uint32_t>& vertices) {
  std::vector<glm::vec2> result;
  result.reserve(vertices.size());
  for (const std::uint32_t vertex : vertices) {
    result.push_back({finite_or_zero(accessor.number(vertex, 0)), finite_or_zero(accessor.number(vertex, 1))});
  }
  return result;
}

bool has_translucent(const GltfAccessor& colours, const std::vector<std::uint32_t>& vertices) {
  return colours.components() == 4 && std::any_of(vertices.begin(), vertices.end(),
                                                  [&](std::uint32_t vertex) { return colours.number(vertex, 3) < 1; });
}

}  // namespace

GltfSurface GltfSurfaces::read(const GltfValue& primitive) {
  GltfSurface surface;
  const GltfValue attributes = primitive.at("attributes");
  const std::optional<GltfValue> position = attributes.find("POSITION");
  const std::optional<Mode> mode = mode_of(primitive);
  if (!mode || !position) {
    file_.warn(primitive, "points, lines, and surfaces without positions are left out");
    return surface;
  }
  if (const auto material = primitive.find("material")) {
    surface.material = material->as_index();
    file_.root.element("materials", surface.material, *material);  // throws if there is none
  }
  const std::uint32_t vertex_count = accessors_.open(position->as_index(), *position).count();
  std::vector<std::uint32_t> corners = read_corners(primitive, vertex_count);
  const std::uint64_t count = triangle_count(*mode, corners.size());
  if (*mode == Mode::Triangles && corners.size() % 3 != 0) file_.warn(primitive, "corners that make no triangle");
  check_count(primitive, count);
  corners.resize(corner_count(*mode, count));
  const std::vector<std::uint32_t> vertices = number_anew(corners, vertex_count);
  surface.triangles = list_triangles(*mode, static_cast<std::uint32_t>(count), corners);
  read_attributes(attributes, vertices, surface);
  if (primitive.count("targets") > 0) file_.warn(primitive, "morph targets are ignored");
  return surface;
}

void GltfSurfaces::check_count(const GltfValue& primitive, std::uint64_t triangles) const {
  if (triangles <= file_.limits.max_faces) return;
  primitive.fail(Cause::TooLarge, "more than " + std::to_string(file_.limits.max_faces) + " triangles");
}

/// The vertex of each corner; without indices they follow each other.
std::vector<std::uint32_t> GltfSurfaces::read_corners(const GltfValue& primitive, std::uint32_t vertex_count) {
  std::vector<std::uint32_t> corners;
  const std::optional<GltfValue> index = primitive.find("indices");
  if (!index) {
    check_count(primitive, vertex_count / 3);
    corners.resize(vertex_count);
    for (std::uint32_t i = 0; i < vertex_count; ++i) corners[i] = i;
    return corners;
  }
  const GltfAccessor& indices = accessors_.open(index->as_index(), *index);
  if (indices.components() != 1 || !indices.is_unsigned_integer() || indices.is_normalised()) {
    indices.fail(Cause::BadValue, "indices have to be unsigned integers");
  }
  corners.reserve(indices.count());
  for (std::uint32_t i = 0; i < indices.count(); ++i) {
    const auto vertex = static_cast<std::uint32_t>(indices.number(i, 0));
    if (vertex >= vertex_count) {
      indices.fail(Cause::BadIndex, "index " + std::to_string(i) + " names vertex " + std::to_string(vertex) + " of " +
                                        std::to_string(vertex_count));
    }
    corners.push_back(vertex);
  }
  return corners;
}

/// Replaces the vertices' numbers by their places among those that are used, which are returned in ascending order.
std::vector<std::uint32_t> GltfSurfaces::number_anew(std::vector<std::uint32_t>& corners, std::uint32_t vertex_count) {
  if (new_numbers_.size() < vertex_count) new_numbers_.resize(vertex_count, kNoIndex);
  std::vector<std::uint32_t> used;
  for (const std::uint32_t corner : corners) {
    if (new_numbers_[corner] != kNoIndex) continue;
    new_numbers_[corner] = 0;
    used.push_back(corner);
  }
  std::sort(used.begin(), used.end());
  for (std::uint32_t i = 0; i < used.size(); ++i) new_numbers_[used[i]] = i;
  for (std::uint32_t& corner : corners) corner = new_numbers_[corner];
  for (const std::uint32_t vertex : used) new_numbers_[vertex] = kNoIndex;
  return used;
}

/// Null if there is none.
const GltfAccessor* GltfSurfaces::open(const GltfValue& attributes, std::string_view name, std::uint32_t vertex_count,
                                       int least_components, int most_components) {
  const std::optional<GltfValue> index = attributes.find(name);
  if (!index) return nullptr;
  const GltfAccessor& accessor = accessors_.open(index->as_index(), *index);
  if (accessor.components() < least_components || accessor.components() > most_components) {
    index->fail(Cause::BadValue, accessor.path() + " has " + std::to_string(accessor.components()) + " components");
  }
  if (accessor.count() < vertex_count) {
    index->fail(Cause::BadIndex, accessor.path() + " has " + std::to_string(accessor.count()) + " elements for " +
                                     std::to_string(vertex_count) + " vertices");
  }
  return &accessor;
}

void GltfSurfaces::read_attributes(const GltfValue& attributes, const std::vector<std::uint32_t>& vertices,
                                   GltfSurface& surface) {
  const GltfAccessor& positions = *open(attributes, "POSITION", 0, 3, 3);
  const std::uint32_t count = positions.count();
  surface.positions = read_positions(positions, vertices);
  if (const GltfAccessor* const normals = open(attributes, "NORMAL", count, 3, 3)) {
    surface.normals = read_vectors(*normals, vertices);
  }
  const std::string set = "TEXCOORD_" + std::to_string(coordinate_set(surface.material));
  if (const GltfAccessor* const coordinates = open(attributes, set, count, 2, 2)) {
    surface.texture_coordinates = read_pairs(*coordinates, vertices);
  }
  read_joints(attributes, vertices, count, surface);
  const GltfAccessor* const colours = open(attributes, "COLOR_0", count, 3, 4);
  if (colours == nullptr) return;
  surface.colours = read_vectors(*colours, vertices);
  for (Vector& colour : surface.colours) {
    for (int i = 0; i < 3; ++i) colour[i] = std::clamp(colour[i], 0.0f, 1.0f);
  }
  if (has_translucent(*colours, vertices)) file_.warn(attributes, "the alpha of vertices' colours is ignored");
}

void GltfSurfaces::read_joints(const GltfValue& attributes, const std::vector<std::uint32_t>& vertices,
                               std::uint32_t vertex_count, GltfSurface& surface) {
  const GltfAccessor* const joints = open(attributes, "JOINTS_0", vertex_count, 4, 4);
  const GltfAccessor* const weights = open(attributes, "WEIGHTS_0", vertex_count, 4, 4);
  if (joints == nullptr || weights == nullptr) return;
  if (joints->type() != GltfAccessor::Type::Uint8 && joints->type() != GltfAccessor::Type::Uint16) {
    joints->fail(Cause::BadValue, "joints have to be unsigned integers of 8 or 16 bits");
  }
  if (attributes.find("JOINTS_1")) file_.warn(attributes, "a vertex hangs on its first four joints alone");
  surface.joints.reserve(vertices.size());
  for (const std::uint32_t vertex : vertices) {
    GltfSurface::Joints& hold = surface.joints.emplace_back();
    for (int k = 0; k < 4; ++k) {
      hold.joints[k] = static_cast<std::uint16_t>(joints->number(vertex, k));
      hold.weights[k] = finite_or_zero(weights->number(vertex, k));
    }
  }
}

std::uint32_t GltfSurfaces::coordinate_set(std::uint32_t material) const {
  return material == kNoIndex ? 0 : coordinate_sets_[material];
}

}  // namespace facemap
