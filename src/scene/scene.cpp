#include <facemap/error.h>
#include <facemap/scene.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <mutex>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

#include "parallel/executor.h"
#include "scene/check_mesh.h"
#include "scene/cut_outs.h"
#include "scene/file_mapping.h"
#include "scene/model_format.h"
#include "scene/obj_reader.h"
#include "scene/odd_faces.h"
#include "scene/pieces.h"
#include "scene/read_model.h"
#include "scene/vertex_bounds.h"
#include "simd/floating_point_mode.h"

namespace facemap {

namespace {

constexpr std::size_t kSmallScene = 1 << 16;  ///< faces below which threads cost more than they gain
constexpr std::size_t kLeastPiece = 1 << 13;  ///< faces worth a task of their own

/// What a model of a format other than OBJ holds, in the words of OBJ.
OBJ::Report report_of(const Mesh& mesh, std::size_t objects, std::vector<std::string>&& warnings) {
  OBJ::Report report;
  report.vertices = static_cast<std::int64_t>(mesh.positions.size());
  report.texture_coordinates = static_cast<std::int64_t>(mesh.texture_coordinates.size());
  report.normals = static_cast<std::int64_t>(mesh.normals.size());
  report.triangles = static_cast<std::int64_t>(mesh.face_count());
  report.polygons = mesh.polygons.empty() ? report.triangles : std::int64_t{mesh.polygons.back()} + 1;
  report.objects = static_cast<std::int64_t>(objects);
  report.warnings = std::move(warnings);
  return report;
}

std::vector<ObjectRun> runs_of(const std::vector<std::uint32_t>& objects, std::size_t faces, std::size_t count) {
  if (!objects.empty() && objects.size() != faces) throw Error("the model has not one object for each triangle");
  std::vector<ObjectRun> runs;
  for (std::size_t face = 0; face < objects.size(); ++face) {
    if (objects[face] >= count && objects[face] != kNoIndex) {
      throw Error("object " + std::to_string(objects[face]) + " of " + std::to_string(count));
    }
    if (runs.empty() || runs.back().object != objects[face]) runs.push_back({face, objects[face]});
  }
  return runs;
}

constexpr TextureUse Material::*kMaps[] = {
    &Material::diffuse_map,   &Material::opacity_map,  &Material::specular_map,
    &Material::shininess_map, &Material::emission_map, &Material::metallic_map,
    &Material::roughness_map, &Material::normal_map,   &Material::bump_map,
};

std::vector<Material> without_maps(std::vector<Material> materials) {
  for (Material& material : materials) {
    for (const auto map : kMaps) material.*map = TextureUse();
  }
  return materials;
}

void check_images(const std::vector<Material>& materials, std::size_t count) {
  for (const Material& material : materials) {
    for (const auto map : kMaps) {
      const TextureUse& use = material.*map;
      if (use.is_used() && use.image >= count) {
        throw Error("image " + std::to_string(use.image) + " of " + std::to_string(count));
      }
    }
  }
}

}  // namespace

struct Scene::KnownCutOuts {
  std::mutex finding;
  std::map<std::uint64_t, std::shared_ptr<const CutOuts>> by_limit;  ///< of an image's pixels
};

Scene::Scene(Mesh mesh, std::vector<Material> materials, int threads)
    : Scene(std::move(mesh), without_maps(std::move(materials)), {}, {}, threads) {}

Scene::Scene(Model model, int threads)
    : Scene(std::move(model.mesh), std::move(model.materials), std::move(model.images), {}, threads) {
  shared_->lights = std::move(model.lights);
  shared_->cameras = std::move(model.cameras);
  shared_->up = model.up;
  shared_->report = report_of(mesh(), model.objects.size(), std::move(model.warnings));
  shared_->object_runs = runs_of(model.triangle_objects, face_count(), model.objects.size());
  shared_->objects = std::move(model.objects);
}

Scene::Scene(Mesh mesh, std::vector<Material> materials, std::vector<TextureImage> images,
             const std::vector<SmoothingRun>& smoothing, int threads)
    : shared_(std::make_shared<Shared>()), known_cut_outs_(std::make_shared<KnownCutOuts>()) {
  const FloatingPointMode mode;
  shared_->mesh = std::move(mesh);
  shared_->materials = std::move(materials);
  shared_->images = std::move(images);
  const Executor executor(face_count() < kSmallScene ? 1 : threads);
  check_mesh(shared_->mesh, shared_->materials.size(), executor);
  check_images(shared_->materials, shared_->images.size());
  // Normals are made one after the other, and faces are judged by their positions: side by side.
  executor.for_each(2, [&](std::size_t task, int) {
    if (task == 0 && !smoothing.empty()) add_smooth_normals(shared_->mesh, smoothing);
    if (task == 1) examine_faces(executor);
  });
}

std::uint32_t Scene::object_of(std::size_t face) const {
  const std::vector<ObjectRun>& runs = shared_->object_runs;
  const auto next = std::upper_bound(runs.begin(), runs.end(), face, [](std::size_t wanted, const ObjectRun& run) {
    return wanted < run.first_triangle;
  });
  return next == runs.begin() ? kNoIndex : std::prev(next)->object;
}

Scene::Scene(const Scene& whole, std::vector<std::uint8_t> kept) : shared_(whole.shared_), kept_(std::move(kept)) {
  const Executor executor(1);
  list_kept_faces(executor);
  find_bounds(executor);
}

std::shared_ptr<const CutOuts> Scene::cut_outs(std::uint64_t max_texture_pixels, int threads) const {
  if (known_cut_outs_ == nullptr) return nullptr;
  const std::scoped_lock lock(known_cut_outs_->finding);
  auto& known = known_cut_outs_->by_limit;
  const auto found = known.find(max_texture_pixels);
  if (found != known.end()) return found->second;
  return known[max_texture_pixels] = CutOuts::find(*this, max_texture_pixels, threads);
}

void Scene::examine_faces(const Executor& executor) {
  shared_->welded = weld(mesh().positions, executor);
  shared_->odd = find_odd_faces(mesh(), welded(), executor, kept_);
  list_kept_faces(executor);
  find_bounds(executor);
}

Scene Scene::load(const std::filesystem::path& path, int threads) {
  ModelLimits limits;
  limits.threads = threads;
  return load(path, limits);
}

Scene Scene::load(const std::filesystem::path& path, const ModelLimits& limits) {
  const FloatingPointMode mode;
  std::optional<FileMapping> file(std::in_place, path, limits.max_bytes);
  const ModelFormat format = sniff_format(file->text(), path.extension());
  if (format == ModelFormat::Obj) {
    ObjModel model = load_obj(file, path, {limits.max_bytes, limits.max_faces, limits.threads, limits.allow_outside});
    Scene scene(std::move(model.mesh), std::move(model.materials), std::move(model.images), model.smoothing,
                limits.threads);
    scene.shared_->report = std::move(model.report);
    scene.shared_->objects = std::move(model.objects);
    scene.shared_->object_runs = std::move(model.object_runs);
    return scene;
  }
  const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : ".";
  Model model = read_model(format, file->text(), path.string(), folder, limits);
  file.reset();
  return Scene(std::move(model), limits.threads);
}

void Scene::list_kept_faces(const Executor& executor) {
  const Pieces pieces(executor, face_count(), kLeastPiece);
  std::vector<std::size_t> begins(pieces.size() + 1, 0);
  executor.for_each(pieces.size(), [&](std::size_t piece, int) {
    begins[piece + 1] = static_cast<std::size_t>(
        std::count(kept_.begin() + pieces.offset(piece), kept_.begin() + pieces.offset(piece + 1), std::uint8_t{1}));
  });
  std::partial_sum(begins.begin(), begins.end(), begins.begin());
  kept_faces_.resize(begins.back());
  executor.for_each(pieces.size(), [&](std::size_t piece, int) {
    std::size_t place = begins[piece];
    for (std::size_t face = pieces.begin(piece); face != pieces.end(piece); ++face) {
      if (is_kept(face)) kept_faces_[place++] = static_cast<std::uint32_t>(face);
    }
  });
}

void Scene::find_bounds(const Executor& executor) {
  const VertexBounds bounds(mesh(), kept_faces_, executor);
  const auto [lower, upper] = bounds.box();
  lower_ = lower;
  upper_ = upper;
  centre_ = (DVector(lower_) + DVector(upper_)) * 0.5;
  bounding_radius_ = std::sqrt(bounds.farthest_squared(centre_));
}

}  // namespace facemap
