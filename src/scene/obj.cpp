#include <facemap/error.h>
#include <facemap/obj.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "scene/obj_reader.h"
#include "simd/floating_point_mode.h"

namespace facemap {

namespace {

constexpr std::size_t kLargeFile = std::size_t{1} << 25;  ///< bytes: its pages are given back as they have been read

}  // namespace

ObjModel load_obj(std::optional<FileMapping>& file, const std::filesystem::path& path, const OBJ::Limits& limits) {
  const FloatingPointMode mode;
  const std::string name = path.string();
  ObjReader reader(file->text(), name, path.has_parent_path() ? path.parent_path() : ".", limits);
  const bool is_large = file->text().size() >= kLargeFile;
  reader.read(is_large ? [&file](std::string_view part) { file->release(part); } : ObjChunks::Release());
  file.reset();  // before finish() takes memory of its own
  return reader.finish();
}

OBJ::OBJ(ObjModel&& model)
    : mesh_(std::move(model.mesh)),
      materials_(std::move(model.materials)),
      images_(std::move(model.images)),
      report_(std::move(model.report)) {
  const FloatingPointMode mode;
  if (!model.smoothing.empty()) add_smooth_normals(mesh_, model.smoothing);
}

OBJ OBJ::load(const std::filesystem::path& path, const Limits& limits) {
  std::optional<FileMapping> file(std::in_place, path, limits.max_bytes);
  return OBJ(load_obj(file, path, limits));
}

OBJ OBJ::parse(std::string_view text, const std::string& name, const std::filesystem::path& directory,
               const Limits& limits) {
  const FloatingPointMode mode;
  if (text.size() > limits.max_bytes) {
    throw LoadError(LoadError::Cause::TooLarge, name, 0, "more than " + std::to_string(limits.max_bytes) + " bytes");
  }
  ObjReader reader(text, name, directory, limits);
  reader.read();
  return OBJ(reader.finish());
}

std::vector<Face> OBJ::faces() const {
  std::vector<Face> result;
  result.reserve(mesh_.face_count());
  for (std::size_t face = 0; face < mesh_.face_count(); ++face) result.push_back(mesh_.face(face));
  return result;
}

}  // namespace facemap
