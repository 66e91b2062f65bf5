#include "scene/ply_faces.h"

#include <facemap/color.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "scene/reserve_pages.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;
using Use = PlyFaceRow::Use;

std::size_t find_indices(const PlyElement& element) {
  const std::size_t plural = element.find("vertex_indices");
  return plural != kNoProperty ? plural : element.find("vertex_index");
}

}  // namespace

bool PlyFaces::has_indices(const PlyElement& element) { return find_indices(element) != kNoProperty; }

/// Finds out what to read of each row.
void PlyFaces::plan(PlyBody& body, const PlyElement& element, std::uint32_t texture_count) {
  const std::size_t indices = find_indices(element);
  if (!element.properties[indices].is_list || !is_whole(element.properties[indices].type)) {
    body.fail_whole(Cause::UnknownFormat, "property \"" + element.properties[indices].name + "\" of element \"" +
                                              element.name + "\" is no list of whole numbers");
  }
  row_ = PlyFaceRow();
  row_.uses.assign(element.properties.size(), Use::Skip);
  row_.uses[indices] = Use::Indices;

  const auto want = [&](std::string_view name, bool is_list, Use use) {
    const std::size_t property = element.find(name);
    if (property == kNoProperty || element.properties[property].is_list != is_list) return false;
    row_.uses[property] = use;
    return true;
  };
  want("texcoord", true, Use::TextureCoordinates);
  texture_count_ = texture_count;
  if (texture_count > 1) want("texnumber", false, Use::TextureNumber);
  has_colours_ = texture_count == 0 && want("red", false, Use::Red) && want("green", false, Use::Green) &&
                 want("blue", false, Use::Blue);
  if (has_colours_) {
    const char* const names[] = {"red", "green", "blue"};
    for (std::size_t i = 0; i < 3; ++i) scales_[i] = colour_scale_of(element.properties[element.find(names[i])].type);
  }
  const std::uint64_t room = std::min({element.count, body.most_rows(element), limits_.max_faces});
  reserve_pages(model_.mesh.triangles, model_.mesh.triangles.size() + room);
}

void PlyFaces::read_polygons(PlyBody& body, const PlyElement& element, std::uint32_t texture_count) {
  plan(body, element, texture_count);
  for (std::uint64_t number = 0; number != element.count; ++number) {
    number += add_triangles(body, element, element.count - number);
    if (number == element.count) break;
    body.read_face(element, number, row_);
    add_polygon(body, element, number);
  }
}

void PlyFaces::read_strips(PlyBody& body, const PlyElement& element, std::uint32_t texture_count) {
  plan(body, element, texture_count);
  for (std::uint64_t number = 0; number != element.count; ++number) {
    body.read_face(element, number, row_);
    add_strip(body, element, number);
  }
}

/// Adds `rows` rows or fewer, of those that are plain triangles, and returns how many.
std::uint64_t PlyFaces::add_triangles(PlyBody& body, const PlyElement& element, std::uint64_t rows) {
  if (texture_count_ != 0) return 0;
  std::vector<Corners>& triangles = model_.mesh.triangles;
  const std::uint64_t most = std::min<std::uint64_t>(rows, limits_.max_faces - triangles.size());
  const std::uint64_t count =
      body.read_triangles(element, row_, static_cast<std::uint64_t>(vertex_count_), most, triangles);
  faces_.count_triangles(count);
  return count;
}

void PlyFaces::add_polygon(PlyBody& body, const PlyElement& element, std::uint64_t number) {
  corners_.resize(row_.indices.size());
  for (std::size_t i = 0; i != corners_.size(); ++i) {
    corners_[i] = {vertex(body, element, number, row_.indices[i]), kNoIndex, kNoIndex};
  }
  if (corners_.size() < 3) {
    warnings_.add(body.line(), "face of fewer than 3 corners, left out");
    faces_.leave_out();
    return;
  }
  check_room(body, corners_.size() - 2);
  if (!row_.texture_coordinates.empty()) add_texture_coordinates(body);
  if (texture_count_ != 0 || has_colours_) faces_.set_material(material_of_row(), model_.mesh.triangles.size());
  faces_.add(corners_, body.line(), !model_.mesh.positions.empty());
}

void PlyFaces::add_strip(PlyBody& body, const PlyElement& element, std::uint64_t number) {
  corners_.assign(3, ObjCorner());
  if (texture_count_ != 0) faces_.set_material(0, model_.mesh.triangles.size());
  std::array<std::uint32_t, 3> last{};
  std::size_t length = 0;  // of the strip so far
  for (const std::int64_t index : row_.indices) {
    if (index == -1) {
      length = 0;
      continue;
    }
    last = {last[1], last[2], vertex(body, element, number, index)};
    ++length;
    // Strips are led on by triangles that name a vertex twice.
    if (length < 3 || last[0] == last[1] || last[1] == last[2] || last[2] == last[0]) continue;
    check_room(body, 1);
    const bool is_turned = length % 2 == 0;
    corners_[0].vertex = last[is_turned ? 1 : 0];
    corners_[1].vertex = last[is_turned ? 0 : 1];
    corners_[2].vertex = last[2];
    faces_.add(corners_, body.line(), true);
  }
}

std::uint32_t PlyFaces::vertex(PlyBody& body, const PlyElement& element, std::uint64_t number,
                               std::int64_t index) const {
  if (index < 0 || index >= vertex_count_) {
    body.fail(Cause::BadIndex, element, number,
              "refers to vertex " + std::to_string(index) + " (from 0) of " + std::to_string(vertex_count_));
  }
  return static_cast<std::uint32_t>(index);
}

void PlyFaces::check_room(PlyBody& body, std::size_t triangles) const {
  if (model_.mesh.triangles.size() + triangles > limits_.max_faces) {
    body.fail_whole(Cause::TooLarge, "more than " + std::to_string(limits_.max_faces) + " triangles");
  }
}

/// Gives each corner of the row its own texture coordinates.
void PlyFaces::add_texture_coordinates(PlyBody& body) {
  std::vector<glm::vec2>& all = model_.mesh.texture_coordinates;
  if (row_.texture_coordinates.size() != 2 * corners_.size()) {
    warnings_.add(body.line(), "texture coordinates that are not two a corner, ignored");
    return;
  }
  if (all.size() + corners_.size() >= kNoIndex) {
    body.fail_whole(Cause::TooLarge, "more than 2^32 - 2 texture coordinates");
  }
  for (std::size_t i = 0; i != corners_.size(); ++i) {
    const float u = row_.texture_coordinates[2 * i], v = row_.texture_coordinates[2 * i + 1];
    const bool is_finite = std::isfinite(u) && std::isfinite(v);
    if (!is_finite) warnings_.add(body.line(), "texture coordinates that are not finite, taken for 0");
    corners_[i].texture = static_cast<std::uint32_t>(all.size());
    all.push_back(is_finite ? glm::vec2(u, v) : glm::vec2(0));
  }
}

std::uint32_t PlyFaces::material_of_row() {
  if (texture_count_ != 0) {
    // MeshLab writes -1 for faces without a texture.
    const bool is_known = row_.texture_number >= 0 && row_.texture_number < std::int64_t{texture_count_};
    return is_known ? static_cast<std::uint32_t>(row_.texture_number) : kNoIndex;
  }
  bool is_inside = true;
  const Color colour = {linear_channel(row_.colour[0], scales_[0], is_inside),
                        linear_channel(row_.colour[1], scales_[1], is_inside),
                        linear_channel(row_.colour[2], scales_[2], is_inside)};
  return colours_.of(colour.to_24_bit());
}

}  // namespace facemap
