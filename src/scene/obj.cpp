#include <facemap/error.h>
#include <facemap/obj.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "scene/file_mapping.h"
#include "scene/obj_reader.h"
#include "simd/floating_point_mode.h"

namespace facemap {

namespace {

void check_encoding(std::string_view text, const std::string& name) {
  using Cause = LoadError::Cause;
  if (text.starts_with("\xFE\xFF") || text.starts_with("\xFF\xFE")) {
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

}  // namespace

OBJ::OBJ(ObjReader&& reader)
    : mesh_(std::move(reader.mesh)), materials_(std::move(reader.materials)), report_(std::move(reader.report)) {}

OBJ OBJ::load(const std::filesystem::path& path, const Limits& limits) {
  const FloatingPointMode mode;
  const std::string name = path.string();
  std::optional<FileMapping> file(std::in_place, path, limits.max_bytes);
  check_encoding(file->text(), name);
  ObjReader reader(file->text(), name, path.has_parent_path() ? path.parent_path() : ".", limits);
  reader.read();
  file.reset();  // before finish() takes memory of its own
  reader.finish();
  return OBJ(std::move(reader));
}

OBJ OBJ::parse(std::string_view text, const std::string& name, const std::filesystem::path& directory,
               const Limits& limits) {
  const FloatingPointMode mode;
  if (text.size() > limits.max_bytes) {
    throw LoadError(LoadError::Cause::TooLarge, name, 0, "more than " + std::to_string(limits.max_bytes) + " bytes");
  }
  check_encoding(text, name);
  ObjReader reader(text, name, directory, limits);
  reader.read();
  reader.finish();
  return OBJ(std::move(reader));
}

std::vector<Face> OBJ::faces() const {
  std::vector<Face> result;
  result.reserve(mesh_.face_count());
  for (std::size_t face = 0; face < mesh_.face_count(); ++face) result.push_back(mesh_.face(face));
  return result;
}

}  // namespace facemap
