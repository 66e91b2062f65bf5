#include "scene/obj_reader.h"

#include <algorithm>
#include <utility>

#include "scene/number.h"
#include "scene/obj_sizes.h"
#include "scene/reserve_pages.h"

namespace facemap {

namespace {

const Vector kWhite(1);

/// The end of the line, or a comment behind a statement.
bool at_end(const char* at) { return *at == '\n' || *at == '#'; }

std::string_view token_at(const char* at) { return {at, static_cast<std::size_t>(skip_token(at) - at)}; }

bool is_utf_16(std::string_view text) { return text.starts_with("\xFE\xFF") || text.starts_with("\xFF\xFE"); }

void check_encoding(std::string_view text, const std::string& name) {
  using Cause = LoadError::Cause;
  if (is_utf_16(text)) {
    throw LoadError(Cause::BadEncoding, name, 0, "UTF-16 text; OBJ is ASCII or UTF-8");
  }
  const std::size_t nul = text.find('\0');
  if (nul != std::string_view::npos) {
    const std::int64_t line = 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(nul), '\n');
    throw LoadError(Cause::BadEncoding, name, line, "a NUL byte: not a text file, or UTF-16");
  }
  if (text.find('\n') == std::string_view::npos && text.find('\r') != std::string_view::npos) {
    throw LoadError(Cause::BadEncoding, name, 0, "lines end in carriage returns alone");
  }
}

std::string quoted(std::string_view text) { return "\"" + printable(text) + "\""; }

}  // namespace

ObjReader::ObjReader(std::string_view text, std::string name, const std::filesystem::path& directory,
                     const OBJ::Limits& limits)
    : name_(std::move(name)),
      limits_(limits),
      text_(text),
      lines_(text),
      warnings_(name_),
      mtl_(directory, limits.max_bytes, limits.allow_outside),
      faces_(model_.mesh, warnings_) {}

void ObjReader::read(const ObjChunks::Release& release) {
  if (read_in_chunks(release)) return;
  check_encoding(text_, name_);
  const ObjSizes sizes = estimate_sizes(text_);
  reserve_pages(model_.mesh.positions, sizes.vertices);
  reserve_pages(model_.mesh.texture_coordinates, sizes.texture_coordinates);
  reserve_pages(model_.mesh.normals, sizes.normals);
  reserve_pages(model_.mesh.triangles, std::min<std::uint64_t>(sizes.triangles, limits_.max_faces));
  while (lines_.next()) {
    line_ = lines_.number();
    read_statement();
  }
}

/// False if the text is too short for it, or odd in some way: read() then says in which.
bool ObjReader::read_in_chunks(const ObjChunks::Release& release) {
  if (limits_.threads == 1 || text_.size() < ObjChunks::kLeastBytes) return false;
  if (is_utf_16(text_) || text_.find('\n') == std::string_view::npos) return false;
  executor_.emplace(limits_.threads);
  if (executor_->threads() > 1 && chunks_.read(text_, *executor_, release) &&
      chunks_.triangle_count() <= limits_.max_faces) {
    return true;
  }
  chunks_ = ObjChunks();
  executor_.reset();
  return false;
}

void ObjReader::merge_chunks() {
  chunks_.move_to(model_.mesh, *executor_);
  model_.report.polygons = chunks_.polygon_count();
  chunks_.visit(
      model_.mesh, *executor_,
      [this](std::size_t first, std::size_t corner_count, std::int64_t line) { faces_.cut(first, corner_count, line); },
      [this](const char* statement, std::int64_t line, std::size_t next_triangle) {
        line_ = line;
        next_triangle_ = next_triangle;
        read_other_statement(statement);
      });
  chunks_ = ObjChunks();
}

void ObjReader::read_statement() {
  const char* const at = skip_blanks(lines_.begin());
  if (at[0] == 'v') {
    if (ends_token(at[1])) return read_vertex(at + 1);
    if (at[1] == 'n' && ends_token(at[2])) return read_normal(at + 2);
    if (at[1] == 't' && ends_token(at[2])) return read_texture_coordinates(at + 2);
  }
  if (at[0] == 'f' && ends_token(at[1])) return read_face(at + 1);
  if (at_end(at)) return;
  next_triangle_ = model_.mesh.triangles.size();
  read_other_statement(at);
}

void ObjReader::read_other_statement(const char* at) {
  const std::string_view keyword = token_at(at);
  at += keyword.size();
  if (keyword == "usemtl") {
    faces_.set_material(mtl_.use(rest_of_line(at), line_), next_triangle_);
  } else if (keyword == "mtllib") {
    mtl_.read_libraries(rest_of_line(at), line_, warnings_);
  } else if (keyword == "s") {
    read_smoothing_group(at);
  } else if (keyword == "o") {
    ++model_.report.objects;
    objects_.begin_object(rest_of_line(at), next_triangle_);
  } else if (keyword == "g") {
    ++model_.report.groups;
    objects_.begin_group(rest_of_line(at), next_triangle_);
  } else {
    ignore(keyword);
  }
}

void ObjReader::read_vertex(const char* at) {
  Vector position;
  at = read_float(at, position.x);
  at = read_float(at, position.y);
  at = read_float(at, position.z);
  model_.mesh.positions.push_back(position);
  at = skip_blanks(at);
  if (!at_end(at)) {
    read_colour(at);
  } else if (!model_.mesh.colours.empty()) {
    model_.mesh.colours.push_back(kWhite);
  }
}

/// Reads what follows a position: the weight w of free-form geometry, a colour, or the one and the other.
void ObjReader::read_colour(const char* at) {
  float extras[4];
  const int count = read_floats(at, extras, 4);
  if (count == 2) warnings_.add(line_, "v with 5 numbers, the last two ignored");
  if (count < 3) {
    if (!model_.mesh.colours.empty()) model_.mesh.colours.push_back(kWhite);
    return;
  }
  const float* const rgb = extras + count - 3;
  const Vector colour(rgb[0], rgb[1], rgb[2]);
  const Vector clamped(std::clamp(colour.x, 0.0f, 1.0f), std::clamp(colour.y, 0.0f, 1.0f),
                       std::clamp(colour.z, 0.0f, 1.0f));
  if (clamped != colour) warnings_.add(line_, "vertex colour outside 0..1, clamped");
  model_.mesh.colours.resize(model_.mesh.positions.size() - 1, kWhite);
  model_.mesh.colours.push_back(clamped);
}

void ObjReader::read_normal(const char* at) {
  Vector normal;
  at = read_float(at, normal.x);
  at = read_float(at, normal.y);
  at = read_float(at, normal.z);
  model_.mesh.normals.push_back(normal);
  read_floats(skip_blanks(at), nullptr, 0);
}

void ObjReader::read_texture_coordinates(const char* at) {
  glm::vec2 coordinates(0);
  at = skip_blanks(read_float(at, coordinates.x));
  if (!at_end(at)) at = skip_blanks(read_float(at, coordinates.y));
  model_.mesh.texture_coordinates.push_back(coordinates);
  float depth;
  if (!at_end(at)) read_floats(at, &depth, 1);
}

/// Reads an index that counts from 1 and names one of `count` that have been read; read_odd_index the others.
inline const char* ObjReader::read_index(const char* const start, std::size_t count, IndexKind& kind,
                                         std::uint32_t& index) {
  constexpr std::ptrdiff_t kMostDigits = 9;  // that surely fit 32 bits
  std::uint32_t written = 0;
  const char* at = start;
  while (is_digit(*at)) written = 10 * written + static_cast<std::uint32_t>(*at++ - '0');
  index = written - 1;
  return index < count && at - start <= kMostDigits ? at : read_odd_index(start, count, kind, index);
}

const char* ObjReader::read_odd_index(const char* const start, std::size_t count, IndexKind& kind,
                                      std::uint32_t& index) {
  std::int64_t written;
  const char* const at = scan_index(start, written);
  if (at == nullptr) fail_number(start);
  const auto known = static_cast<std::int64_t>(count);
  if (written < 0 && -written <= known) {
    index = static_cast<std::uint32_t>(known + written);
  } else if (written > 0) {
    index = static_cast<std::uint32_t>(written - 1);
    if (written > known) note_forward(written, kind);
  } else {
    fail(LoadError::Cause::BadIndex, "face refers to " + std::string(kind.noun) + " " + std::to_string(written) +
                                         ", with " + std::to_string(known) + " before it");
  }
  return at;
}

/// Reads v, v/t, v//n or v/t/n.
inline const char* ObjReader::read_corner(const char* const start, ObjCorner& corner) {
  const char* at = read_index(start, model_.mesh.positions.size(), vertex_indices_, corner.vertex);
  if (*at == '/') {
    ++at;
    if (*at != '/' && !ends_token(*at)) {
      at = read_index(at, model_.mesh.texture_coordinates.size(), texture_indices_, corner.texture);
    }
    if (*at == '/') {
      ++at;
      if (!ends_token(*at)) at = read_index(at, model_.mesh.normals.size(), normal_indices_, corner.normal);
    }
  }
  if (!ends_token(*at)) fail_number(start);
  return at;
}

void ObjReader::read_face(const char* at) {
  corners_.clear();
  is_complete_ = true;
  for (at = skip_blanks(at); !at_end(at); at = skip_blanks(at)) at = read_corner(at, corners_.emplace_back());
  if (corners_.size() < 3) fail(LoadError::Cause::TruncatedStatement, "face of fewer than 3 corners");
  if (model_.mesh.triangles.size() + corners_.size() - 2 > limits_.max_faces) {
    fail(LoadError::Cause::TooLarge, "more than " + std::to_string(limits_.max_faces) + " triangles");
  }
  ++model_.report.polygons;
  faces_.add(corners_, line_, is_complete_);
}

void ObjReader::note_forward(std::int64_t index, IndexKind& kind) {
  if (kind.forward.empty() || index > kind.forward.back().index) kind.forward.push_back({index, line_});
  is_complete_ = false;
}

void ObjReader::check_forward(const IndexKind& kind, std::size_t count) const {
  for (const ForwardIndex& forward : kind.forward) {
    if (forward.index > static_cast<std::int64_t>(count)) {
      throw LoadError(LoadError::Cause::BadIndex, name_, forward.line,
                      "face refers to " + std::string(kind.noun) + " " + std::to_string(forward.index) + " of " +
                          std::to_string(count));
    }
  }
}

void ObjReader::read_smoothing_group(const char* at) {
  const std::string_view group = rest_of_line(at);
  std::int64_t number = 0;
  const bool is_off = group.empty() || group == "off";
  if (!is_off) {
    const char* const end = scan_index(group.data(), number);
    if (end != group.data() + group.size() || number < 0 || number > UINT32_MAX) {
      warnings_.add(line_, "smoothing group is not a number, taken for off", group);
      number = 0;
    }
  }
  faces_.set_smoothing_group(static_cast<std::uint32_t>(number), next_triangle_);
}

const char* ObjReader::read_float(const char* at, float& value) {
  at = skip_blanks(at);
  const char* const end = scan_float(at, value);
  if (end == nullptr) fail_number(at);
  return end;
}

/// Reads the numbers up to the end of the line and keeps `most` of them; more are a warning. Returns how many
/// were kept.
int ObjReader::read_floats(const char* at, float* values, int most) {
  int count = 0;
  for (; !at_end(at); at = skip_blanks(at)) {
    float value;
    at = read_float(at, value);
    if (count < most) {
      values[count++] = value;
    } else {
      warnings_.add(line_, "more numbers than the statement has, ignored");
    }
  }
  return count;
}

void ObjReader::ignore(std::string_view keyword) {
  constexpr std::size_t kMaxKeywords = 64;
  constexpr const char* kOtherKeywords = "(others)";
  const std::string statement = printable(keyword);
  for (OBJ::Ignored& ignored : model_.report.ignored) {
    if (ignored.statement == statement || ignored.statement == kOtherKeywords) {
      ++ignored.count;
      return;
    }
  }
  const bool is_last = model_.report.ignored.size() + 1 == kMaxKeywords;
  model_.report.ignored.push_back({is_last ? kOtherKeywords : statement, 1, line_});
}

ObjModel ObjReader::finish() {
  if (executor_) merge_chunks();
  model_.report.vertices = static_cast<std::int64_t>(model_.mesh.positions.size());
  model_.report.texture_coordinates = static_cast<std::int64_t>(model_.mesh.texture_coordinates.size());
  model_.report.normals = static_cast<std::int64_t>(model_.mesh.normals.size());
  model_.report.triangles = static_cast<std::int64_t>(model_.mesh.triangles.size());
  if (std::max({model_.report.vertices, model_.report.texture_coordinates, model_.report.normals}) >=
      std::int64_t{kNoIndex}) {
    throw LoadError(LoadError::Cause::TooLarge, name_, 0, "more than 2^32 - 2 vertices");
  }
  check_forward(vertex_indices_, model_.mesh.positions.size());
  check_forward(texture_indices_, model_.mesh.texture_coordinates.size());
  check_forward(normal_indices_, model_.mesh.normals.size());
  if (model_.mesh.triangles.empty()) throw LoadError(LoadError::Cause::NoFaces, name_, 0, "no faces");

  faces_.finish();
  model_.report.self_intersecting_polygons = faces_.self_intersecting();
  model_.smoothing = faces_.smoothing_runs();
  mtl_.resolve(model_.mesh.triangle_materials, warnings_);
  model_.materials = std::move(mtl_.materials());
  model_.images = std::move(mtl_.images());
  objects_.take(model_.objects, model_.object_runs);
  warnings_.append_to(model_.report.warnings);
  model_.report.warnings.insert(model_.report.warnings.end(), mtl_.warnings().begin(), mtl_.warnings().end());
  return std::move(model_);
}

void ObjReader::fail(LoadError::Cause cause, const std::string& reason) const {
  throw LoadError(cause, name_, line_, reason);
}

void ObjReader::fail_number(const char* token) const {
  if (at_end(token)) fail(LoadError::Cause::TruncatedStatement, "a number is missing");
  fail(LoadError::Cause::BadNumber, "not a number that a float can hold: " + quoted(token_at(token)));
}

}  // namespace facemap
