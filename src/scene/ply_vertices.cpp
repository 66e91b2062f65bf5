#include "scene/ply_vertices.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "scene/colour_values.h"
#include "scene/reserve_pages.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;
using Names = std::array<std::string_view, 3>;

constexpr Names kPosition = {"x", "y", "z"};
constexpr Names kNormals[] = {{"nx", "ny", "nz"}, {"normal_x", "normal_y", "normal_z"}};
constexpr Names kColours[] = {
    {"red", "green", "blue"}, {"diffuse_red", "diffuse_green", "diffuse_blue"}, {"r", "g", "b"}};
constexpr Names kTextures[] = {
    {"u", "v"}, {"s", "t"}, {"texture_u", "texture_v"}, {"texture_s", "texture_t"}, {"texcoord_u", "texcoord_v"}};

/// Whether the element has scalars of these names (the empty ones left out).
bool has(const PlyElement& element, const Names& names) {
  return std::all_of(names.begin(), names.end(), [&](std::string_view name) {
    if (name.empty()) return true;
    const std::size_t property = element.find(name);
    return property != kNoProperty && !element.properties[property].is_list;
  });
}

bool is_finite(const Vector& v) {
  // Not finite less itself is NaN.
  return (v.x - v.x) + (v.y - v.y) + (v.z - v.z) == 0;
}

class VertexReader {
 public:
  VertexReader(PlyBody& body, const PlyElement& element, Mesh& mesh, ObjWarnings& warnings)
      : body_(body), element_(element), mesh_(mesh), warnings_(warnings) {}

  void read(bool with_texture_coordinates) {
    if (!has(element_, kPosition)) {
      body_.fail_whole(Cause::TruncatedStatement, "element \"vertex\" lacks x, y or z");
    }
    if (element_.count >= kNoIndex) body_.fail_whole(Cause::TooLarge, "more than 2^32 - 2 vertices");
    if (element_.count > body_.most_rows(element_)) {
      body_.fail_whole(Cause::TruncatedStatement,
                       "the file is too short for " + std::to_string(element_.count) + " vertices");
    }
    plan(with_texture_coordinates);
    for (std::uint64_t first = 0; first != element_.count;) {
      const std::uint64_t count = std::min(element_.count - first, body_.rows_at_once());
      body_.read_columns(element_, columns_, first, count);
      for (std::uint64_t row = first; row != first + count; ++row) check(row);
      first += count;
    }
  }

 private:
  void plan(bool with_texture_coordinates) {
    add(kPosition, mesh_.positions);
    for (const Names& names : kNormals) {
      if (mesh_.normals.empty() && has(element_, names)) add(names, mesh_.normals);
    }
    for (const Names& names : kColours) {
      if (!mesh_.colours.empty() || !has(element_, names)) continue;
      add(names, mesh_.colours);
      for (int i = 0; i < 3; ++i) scales_[i] = colour_scale_of(element_.properties[element_.find(names[i])].type);
    }
    for (const Names& names : kTextures) {
      if (!with_texture_coordinates) break;
      if (mesh_.texture_coordinates.empty() && has(element_, names)) add(names, mesh_.texture_coordinates);
    }
    std::sort(columns_.begin(), columns_.end(),
              [](const PlyColumn& a, const PlyColumn& b) { return a.property < b.property; });
  }

  template <class Values>
  void add(const Names& names, Values& values) {
    resize_pages(values, element_.count);
    if (values.empty()) return;
    for (int i = 0; i < static_cast<int>(values[0].length()); ++i) {
      columns_.push_back({element_.find(names[i]), &values[0][i], sizeof(values[0]) / sizeof(float)});
    }
  }

  void check(std::uint64_t row) {
    if (!is_finite(mesh_.positions[row])) {
      body_.fail(Cause::BadNumber, element_, row, "the position is not finite, or too large for a float");
    }
    if (!mesh_.normals.empty() && !is_finite(mesh_.normals[row])) {
      warnings_.add(body_.line(), "normals that are not finite, left out");
      mesh_.normals[row] = Vector(0);
    }
    if (!mesh_.colours.empty()) check_colour(mesh_.colours[row]);
    if (!mesh_.texture_coordinates.empty()) check_coordinates(mesh_.texture_coordinates[row]);
  }

  void check_colour(Vector& colour) {
    bool is_inside = true;
    for (int i = 0; i < 3; ++i) colour[i] = linear_channel(colour[i], scales_[i], is_inside);
    if (!is_inside) warnings_.add(body_.line(), "vertex colour outside its range, clamped");
  }

  void check_coordinates(glm::vec2& coordinates) {
    if (std::isfinite(coordinates.x) && std::isfinite(coordinates.y)) return;
    warnings_.add(body_.line(), "texture coordinates that are not finite, taken for 0");
    coordinates = glm::vec2(0);
  }

  PlyBody& body_;
  const PlyElement& element_;
  Mesh& mesh_;
  ObjWarnings& warnings_;
  std::vector<PlyColumn> columns_;
  std::array<ColourScale, 3> scales_{};
};

}  // namespace

bool has_texture_coordinates(const PlyElement& element) {
  return std::any_of(std::begin(kTextures), std::end(kTextures),
                     [&](const Names& names) { return has(element, names); });
}

void read_ply_vertices(PlyBody& body, const PlyElement& element, bool have_corners_coordinates, Mesh& mesh,
                       ObjWarnings& warnings) {
  VertexReader(body, element, mesh, warnings).read(!have_corners_coordinates);
}

}  // namespace facemap
