#include <facemap/error.h>
#include <facemap/model.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scene/file_mapping.h"
#include "scene/model_format.h"
#include "scene/obj_reader.h"
#include "scene/read_model.h"
#include "simd/floating_point_mode.h"

namespace facemap {

namespace {

OBJ::Limits obj_limits(const ModelLimits& limits) {
  return {limits.max_bytes, limits.max_faces, limits.threads, limits.allow_outside};
}

std::vector<std::uint32_t> object_of_each(const std::vector<ObjectRun>& runs, std::size_t faces) {
  if (runs.empty()) return {};
  std::vector<std::uint32_t> objects(faces, kNoIndex);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    const std::size_t end = i + 1 < runs.size() ? runs[i + 1].first_triangle : faces;
    std::fill(objects.begin() + static_cast<std::ptrdiff_t>(runs[i].first_triangle),
              objects.begin() + static_cast<std::ptrdiff_t>(end), runs[i].object);
  }
  return objects;
}

Model model_of(ObjModel&& obj) {
  add_smooth_normals(obj.mesh, obj.smoothing);
  Model model;
  model.mesh = std::move(obj.mesh);
  model.materials = std::move(obj.materials);
  model.images = std::move(obj.images);
  model.objects = std::move(obj.objects);
  model.triangle_objects = object_of_each(obj.object_runs, model.mesh.face_count());
  model.warnings = std::move(obj.report.warnings);
  return model;
}

}  // namespace

Model load_model(const std::filesystem::path& path, const ModelLimits& limits) {
  const FloatingPointMode mode;
  std::optional<FileMapping> file(std::in_place, path, limits.max_bytes);
  const ModelFormat format = sniff_format(file->text(), path.extension());
  if (format == ModelFormat::Obj) return model_of(load_obj(file, path, obj_limits(limits)));
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  return read_model(format, file->text(), path.string(), folder, limits);
}

Model parse_model(std::string_view bytes, const std::string& name, const std::filesystem::path& directory,
                  const ModelLimits& limits) {
  const FloatingPointMode mode;
  if (bytes.size() > limits.max_bytes) {
    throw LoadError(LoadError::Cause::TooLarge, name, 0, "more than " + std::to_string(limits.max_bytes) + " bytes");
  }
  const ModelFormat format = sniff_format(bytes);
  if (format != ModelFormat::Obj) return read_model(format, bytes, name, directory, limits);
  ObjReader reader(bytes, name, directory, obj_limits(limits));
  reader.read();
  return model_of(reader.finish());
}

}  // namespace facemap
