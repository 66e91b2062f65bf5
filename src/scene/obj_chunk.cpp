#include "scene/obj_chunk.h"

#include <algorithm>
#include <cstring>

#include "scene/number.h"
#include "scene/obj_sizes.h"

namespace facemap {

namespace {

constexpr Corners kNoCorners = {kNoIndex, kNoIndex, kNoIndex};

/// Statements that are kept as text take more memory than the text: a chunk of too many of them is odd.
constexpr std::size_t kBytesAStatement = 64;

/// Where the line ends that `at` stands in; there is an end before `end`.
const char* newline_after(const char* at, const char* end) {
  return static_cast<const char*>(std::memchr(at, '\n', static_cast<std::size_t>(end - at)));
}

/// Whether a backslash before `newline` joins the next line to this one.
bool is_continued(const char* begin, const char* newline) {
  if (newline != begin && newline[-1] == '\r') --newline;
  return newline != begin && newline[-1] == '\\';
}

const char* scan_next_float(const char* at, float& value) { return scan_float(skip_blanks(at), value); }

/// Appends the fan of a face to an array that is empty up to the first face that has such indices.
template <class Index>
void append_fan(std::vector<Corners>& values, const std::vector<Corners>& triangles, std::size_t corner_count,
                const Index& index) {
  if (values.empty()) {
    values.reserve(triangles.capacity());
    values.assign(triangles.size() - (corner_count - 2), kNoCorners);
  }
  for (std::size_t i = 2; i < corner_count; ++i) values.push_back({index(0), index(i - 1), index(i)});
}

}  // namespace

ObjChunk::Outcome ObjChunk::read(std::string_view text, const std::optional<ObjCounts>& before) {
  if (text.size() > kMaxBytes || std::memchr(text.data(), '\0', text.size()) != nullptr) return Outcome::Odd;
  before_ = before;
  reserve(text);
  end_ = text.data() + text.size();
  for (const char* at = text.data(); at != end_; ++lines) {
    at = read_line(at);
    if (at == nullptr) return needs_counts_ ? Outcome::NeedsCounts : Outcome::Odd;
  }
  return Outcome::Done;
}

ObjCounts ObjChunk::count(std::string_view text) {
  ObjCounts counts;
  const char* const end = text.data() + text.size();
  for (const char* at = text.data(); at != end; at = newline_after(at, end) + 1) {
    at = skip_blanks(at);
    if (at[0] != 'v') continue;
    counts.vertices += ends_token(at[1]);
    counts.texture_coordinates += at[1] == 't' && ends_token(at[2]);
    counts.normals += at[1] == 'n' && ends_token(at[2]);
  }
  return counts;
}

bool ObjChunk::is_backward(const ObjCounts& before) const {
  return lacking_.vertices <= before.vertices && lacking_.texture_coordinates <= before.texture_coordinates &&
         lacking_.normals <= before.normals;
}

void ObjChunk::reserve(std::string_view text) {
  const ObjSizes sizes = estimate_sizes(text);
  positions.reserve(sizes.vertices);
  texture_coordinates.reserve(sizes.texture_coordinates);
  normals.reserve(sizes.normals);
  triangles.reserve(sizes.triangles);
  statements_left_ = text.size() / kBytesAStatement + 8;
}

/// The next line, behind blanks and a comment; nullptr if the statement goes on.
const char* ObjChunk::end_line(const char* at) const {
  at = skip_blanks(at);
  if (*at == '\n') return at + 1;
  if (*at != '#') return nullptr;
  const char* const newline = newline_after(at, end_);
  return is_continued(at, newline) ? nullptr : newline + 1;
}

/// Reads a line and returns the next; nullptr if this one is odd.
const char* ObjChunk::read_line(const char* const line) {
  const char* const at = skip_blanks(line);
  if (at[0] == 'v') {
    if (ends_token(at[1])) return read_vector(at + 1, positions, counts.vertices);
    if (at[1] == 'n' && ends_token(at[2])) return read_vector(at + 2, normals, counts.normals);
    if (at[1] == 't' && ends_token(at[2])) return read_texture_coordinates(at + 2);
  }
  if (at[0] == 'f' && ends_token(at[1])) return read_face(at + 1);
  if (at[0] == '\n') return at + 1;
  if (at[0] == '#') return newline_after(at, end_) + 1;
  return read_other(line, at);
}

const char* ObjChunk::read_vector(const char* at, std::vector<Vector>& values, std::int64_t& count) {
  Vector v;
  if ((at = scan_next_float(at, v.x)) == nullptr) return nullptr;
  if ((at = scan_next_float(at, v.y)) == nullptr) return nullptr;
  if ((at = scan_next_float(at, v.z)) == nullptr) return nullptr;
  values.push_back(v);
  ++count;
  return end_line(at);
}

const char* ObjChunk::read_texture_coordinates(const char* at) {
  float values[3] = {0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    if ((at = scan_next_float(at, values[i])) == nullptr) return nullptr;
    at = skip_blanks(at);
    if (*at == '\n' || *at == '#') break;
  }
  ++counts.texture_coordinates;
  texture_coordinates.emplace_back(values[0], values[1]);
  return end_line(at);
}

const char* ObjChunk::read_other(const char* const line, const char* at) {
  const char* const newline = newline_after(at, end_);
  if (is_continued(line, newline) || statements_left_ == 0) return nullptr;
  --statements_left_;
  std::string text(at, newline);
  text.append(1 + kReadableBeyondEnd, '\n');
  statements.push_back({std::move(text), lines, static_cast<std::uint32_t>(triangles.size())});
  return newline + 1;
}

/// Reads an index that counts from 1, and how many must stand before the chunk for it to point backwards.
inline const char* ObjChunk::read_index(const char* const start, std::int64_t ObjCounts::*kind, std::uint32_t& index) {
  std::uint32_t written;
  const int digits = scan_8_digits(start, written);
  if (digits == 0 || is_digit(start[digits])) return read_negative_index(start, kind, index);
  index = written - 1;
  if (written == 0) return nullptr;
  lacking_.*kind = std::max(lacking_.*kind, std::int64_t{written} - counts.*kind);
  return start + digits;
}

/// The same for all other numbers.
const char* ObjChunk::read_negative_index(const char* const start, std::int64_t ObjCounts::*kind,
                                          std::uint32_t& index) {
  std::int64_t written;
  const char* const at = scan_index(start, written);
  if (at == nullptr || written == 0 || written == kHugeIndex) return nullptr;
  if (written < 0) {
    if (!before_) needs_counts_ = true;
    if (!before_ || -written > (*before_).*kind + counts.*kind) return nullptr;
    written += (*before_).*kind + counts.*kind + 1;
  }
  if (written >= std::int64_t{kNoIndex}) return nullptr;
  index = static_cast<std::uint32_t>(written - 1);
  lacking_.*kind = std::max(lacking_.*kind, written - counts.*kind);
  return at;
}

/// Reads v, v/t, v//n or v/t/n.
inline const char* ObjChunk::read_corner(const char* at, Corner& corner) {
  at = read_index(at, &ObjCounts::vertices, corner.vertex);
  if (at != nullptr && *at == '/') {
    ++at;
    if (*at != '/' && !ends_token(*at)) at = read_index(at, &ObjCounts::texture_coordinates, corner.texture);
    if (at != nullptr && *at == '/') {
      ++at;
      if (!ends_token(*at)) at = read_index(at, &ObjCounts::normals, corner.normal);
    }
  }
  return at != nullptr && ends_token(*at) ? at : nullptr;
}

const char* ObjChunk::read_face(const char* at) {
  corners_.clear();
  for (at = skip_blanks(at); *at != '\n' && *at != '#'; at = skip_blanks(at)) {
    corners_.push_back({kNoIndex, kNoIndex, kNoIndex});
    at = read_corner(at, corners_.back());
    if (at == nullptr) return nullptr;
  }
  if (corners_.size() < 3) return nullptr;
  add_face();
  return end_line(at);
}

void ObjChunk::add_face() {
  const std::size_t count = corners_.size(), first = triangles.size();
  std::uint32_t textures = kNoIndex, vertex_normals = kNoIndex;  // these as long as no corner has any
  for (const Corner& corner : corners_) {
    textures &= corner.texture;
    vertex_normals &= corner.normal;
  }
  for (std::size_t i = 2; i < count; ++i) {
    triangles.push_back({corners_[0].vertex, corners_[i - 1].vertex, corners_[i].vertex});
  }
  if (textures != kNoIndex || !texture_corners.empty()) {
    append_fan(texture_corners, triangles, count, [this](std::size_t i) { return corners_[i].texture; });
  }
  if (vertex_normals != kNoIndex || !normal_corners.empty()) {
    append_fan(normal_corners, triangles, count, [this](std::size_t i) { return corners_[i].normal; });
  }
  if (count > 3) fans.push_back({static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(count), lines});
  ++polygons;
}

}  // namespace facemap
