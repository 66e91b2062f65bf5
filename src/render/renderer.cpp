#include <facemap/error.h>
#include <facemap/renderer.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <span>

#include "map/light_lists.h"
#include "material/material_table.h"
#include "parallel/executor.h"
#include "picture/wide_map.h"
#include "render/check_options.h"
#include "render/cost_model.h"
#include "render/crop_margin.h"
#include "render/light_sources.h"
#include "render/painter.h"
#include "render/parallel_eye.h"
#include "render/picture_frame.h"
#include "render/planes.h"
#include "render/stopwatch.h"
#include "render/whole_picture.h"
#include "scene/cut_outs.h"
#include "simd/floating_point_mode.h"
#include "simd/target.h"

namespace facemap {
namespace {

// The map that a lens is asked of: its own if it is a projection, else one of all that it shows.
Camera::Options camera_options(const Lens& lens, Builder builder) {
  Camera::Options options = wide_map(lens);
  if (const Projection* projection = lens.projection()) {
    options.projection = projection->kind();
    options.field_angle = projection->field_angle();
    options.width = lens.width();
    options.height = lens.height();
  }
  options.builder = builder;
  return options;
}

// Of all pixels, or, with edges, about: an eighth to a third of the pixels is divided.
std::size_t samples_of(const Renderer::Options& options) {
  const PixelBox made = made_pixels(options);
  const std::size_t pixels = static_cast<std::size_t>(made.width) * static_cast<std::size_t>(made.height);
  const auto in_pixel = static_cast<std::size_t>(options.samples) * static_cast<std::size_t>(options.samples);
  return pixels * (options.sampling == Renderer::Sampling::Edges ? 1 + in_pixel / 4 : in_pixel);
}

}  // namespace

struct Renderer::Kept {
  explicit Kept(int threads) : executor(threads) {}

  Executor executor;
  std::mutex reporting;
  ListsOfLights lists;                      // null until made
  bool lists_are_full = false;              // no more fit Options::map_memory
  std::shared_ptr<const CutOuts> cut_outs;  // null: all faces are solid
  bool knows_cut_outs = false;
  TransposedState transposed;
  std::unique_ptr<MaterialTable> materials;      // made when colours are first wanted
  double spent_in_vain = 0, lost_to_bounds = 0;  // see PictureWork
};

Renderer::Renderer(const Scene& scene, const View& view, std::vector<Light> lights, const Options& options)
    : scene_(&scene), view_(view), lights_(std::move(lights)), options_(options) {
  const FloatingPointMode mode;
  check_options(options_);
  for (std::size_t i = 0; i < lights_.size(); ++i) check_light(lights_[i], "light " + std::to_string(i));
  set_view(view);
  kept_ = std::make_unique<Kept>(options.threads);
}

Renderer::~Renderer() = default;
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;

void Renderer::set_view(const View& view) {
  const FloatingPointMode mode;
  frame_of(view);
  if (!view.is_parallel) {
    lens_of(view, options_.width, options_.height);
  } else if (!(view.height > 0) || !std::isfinite(view.height)) {
    throw Error("the height of an orthographic view must be finite and above 0");
  }
  view_ = view;
}

struct Renderer::Request {
  Options options;
  bool wants_colours;
  std::function<void(double, const char*)> report;  // throws to stop
};

Image Renderer::render(const Progress& progress) {
  Options options = options_;
  options.planes = asked_planes(options_.planes);
  Image image = make({options, true, [&](double fraction, const char* phase) {
                        if (progress && !progress(fraction, phase)) throw Error("stopped");
                      }});
  fill_planes(image);
  return image;
}

Image Renderer::look(const Progress& progress) {
  Options options = options_;
  options.planes = {Plane::Id, Plane::Lights};
  options.sampling = Sampling::Grid;
  options.builder = Builder::Cover;
  options.normals = Normals::Flat;
  return make({options, false, [&](double fraction, const char* phase) {
                 if (progress && !progress(fraction, phase)) throw Error("stopped");
               }});
}

Image Renderer::make(const Request& request) {
  const FloatingPointMode mode;
  const Options& options = request.options;
  PictureWork work;
  work.faces = scene_->kept_faces().size();
  work.samples = samples_of(options);
  const PixelBox made = made_pixels(options);
  work.lights = lights_.size();
  kept_->lists.resize(lights_.size());
  work.has_lists = std::find(kept_->lists.begin(), kept_->lists.end(), nullptr) == kept_->lists.end();
  work.has_bounds = kept_->transposed.bounds.are_made();
  work.spent_in_vain = kept_->spent_in_vain;
  work.lost_to_bounds = kept_->lost_to_bounds;
  work.map_memory = options.map_memory;
  StrategyChoice choice = choose_strategy(options, work);
  if (view_.is_parallel) choice = {Strategy::Lists, "each ray of an orthographic picture has an origin of its own"};

  statistics_ = Statistics();
  statistics_.strategy = choice.strategy;
  statistics_.reason = choice.reason;
  statistics_.target = simd::name_of(simd::active_target());
  statistics_.threads = kept_->executor.threads();
  find_cut_outs();
  if (request.wants_colours) load_materials();
  const bool by_lists = choice.strategy == Strategy::Lists;
  build_lists(request, by_lists);
  if (view_.is_parallel || is_by_samples(options)) return paint_by_lists(request);

  const PixelBox pixels = request.wants_colours ? pixels_about_crop(options) : made;
  Options of_pixels = options;
  of_pixels.crop = pixels;
  WholePicture picture(*scene_, kept_->cut_outs, view_, lights_, of_pixels, kept_->executor, kept_->transposed,
                       kept_->lists, by_lists, choice.keeps_bounds, kept_->materials.get(), statistics_,
                       request.report);
  const bool by_edges = options.sampling == Sampling::Edges;
  Image image = !request.wants_colours ? picture.look() : by_edges ? picture.paint_edges() : picture.paint();
  if (!(pixels == made)) image = cut(image, pixels, made);
  if (!by_lists) {
    const PictureCost cost = estimate_cost(work);
    kept_->spent_in_vain += std::max(0.0, cost.transposed - cost.lists);
    kept_->lost_to_bounds += cost.transposed - cost.bounded;
    statistics_.map_bytes += kept_->transposed.bounds.memory_bytes() + kept_->transposed.cut_outs.bytes;
    for (const ShadowScratch& scratch : kept_->transposed.scratch) statistics_.map_bytes += scratch.memory_bytes();
  }
  return image;
}

void Renderer::fill_planes(Image& image) {
  const FloatingPointMode mode;
  const Stopwatch time;
  SampleGrid centres = grid_of(view_, options_, 1);
  std::optional<ParallelEye> eye;
  if (options_.planes.empty()) return;
  if (view_.is_parallel) {
    eye.emplace(*scene_, view_, options_);
  } else if (centres.lens.projection() == nullptr) {
    centres.directions = make_directions(centres, kept_->executor);
  }
  facemap::fill_planes({*scene_, centres, options_.normals == Normals::Smooth, kept_->materials.get(), kept_->executor,
                        eye ? &*eye : nullptr},
                       options_.planes, image);
  statistics_.shade_ms += time.milliseconds();
}

void Renderer::find_cut_outs() {
  const Stopwatch time;
  if (options_.materials && !kept_->knows_cut_outs) {
    kept_->cut_outs = scene_->cut_outs(options_.max_texture_pixels, options_.threads);
  }
  kept_->knows_cut_outs = true;
  if (kept_->cut_outs == nullptr) return;
  for (const std::string& warning : kept_->cut_outs->warnings()) warn_once(warning);
  statistics_.shade_ms += time.milliseconds();
}

void Renderer::warn_once(const std::string& warning) {
  std::vector<std::string>& known = statistics_.warnings;
  if (std::find(known.begin(), known.end(), warning) == known.end()) known.push_back(warning);
}

void Renderer::load_materials() {
  if (!options_.materials || !MaterialTable::is_needed(*scene_)) return;
  const Stopwatch time;
  if (kept_->materials == nullptr) {
    kept_->materials = std::make_unique<MaterialTable>(*scene_, options_.max_texture_pixels, kept_->executor);
  }
  for (const std::string& warning : kept_->materials->warnings()) warn_once(warning);
  statistics_.shade_ms += time.milliseconds();
}

// Directional lights have lists with either strategy. With the transposed one those that do not fit Options::map_memory
// are left to WholePicture.
void Renderer::build_lists(const Request& request, bool of_all) {
  const Stopwatch time;
  ListsOfLights& lists = kept_->lists;
  const bool is_limited = !of_all && options_.map_memory != 0;
  std::vector<std::size_t> missing;
  for (std::size_t l = 0; l < lists.size() && !(is_limited && kept_->lists_are_full); ++l) {
    if (lists[l] == nullptr && (of_all || lights_[l].kind == Light::Kind::Directional)) missing.push_back(l);
  }
  std::size_t bytes = 0;
  for (const auto& of_light : lists) bytes += of_light != nullptr ? of_light->memory_bytes() : 0;
  PointLight::Options wanted;
  wanted.builder = request.options.builder;
  wanted.cut_outs = options_.materials;
  wanted.max_texture_pixels = options_.max_texture_pixels;
  std::size_t done = 0;
  const std::size_t together = is_limited ? static_cast<std::size_t>(kept_->executor.threads()) : missing.size();
  for (std::size_t first = 0; first < missing.size(); first += together) {
    const std::span<const std::size_t> next =
        std::span(missing).subspan(first).first(std::min(together, missing.size() - first));
    kept_->executor.for_each(next.size(), [&](std::size_t i, int) {
      lists[next[i]] = std::make_unique<LightLists>(*scene_, lights_[next[i]], wanted);
      const std::scoped_lock lock(kept_->reporting);
      request.report(static_cast<double>(++done) / static_cast<double>(missing.size()), "light maps");
    });
    for (const std::size_t l : next) {
      bytes += lists[l]->memory_bytes();
      if (!is_limited || bytes <= options_.map_memory) continue;
      bytes -= lists[l]->memory_bytes();
      lists[l] = nullptr;
      kept_->lists_are_full = true;
    }
    if (is_limited && kept_->lists_are_full) break;
  }
  statistics_.map_bytes += bytes;
  statistics_.light_maps_ms += time.milliseconds();
}

Image Renderer::paint_by_lists(const Request& request) {
  request.report(0, "camera map");
  const Stopwatch camera_time;
  if (view_.is_parallel) {
    const ParallelEye eye(*scene_, view_, request.options);
    return paint_by_lists(request, eye, eye.memory_bytes(), camera_time.milliseconds());
  }
  const Lens lens = lens_of(view_, request.options.width, request.options.height);
  Camera::Options wanted = camera_options(lens, request.options.builder);
  wanted.cut_outs = options_.materials;
  wanted.max_texture_pixels = options_.max_texture_pixels;
  const Camera camera(*scene_, frame_of(view_), wanted);
  return paint_by_lists(request, CentralEye(camera, lens), camera.memory_bytes(), camera_time.milliseconds());
}

Image Renderer::paint_by_lists(const Request& request, const Eye& eye, std::size_t map_bytes, double made_ms) {
  statistics_.camera_map_ms = made_ms;
  statistics_.map_bytes += map_bytes;
  const Stopwatch shade_time;
  const std::vector<simd::LightSource> sources = light_sources(lights_, request.options.falloff);
  Painter painter(view_, eye, sources, kept_->lists, request.options, kept_->materials.get(), kept_->executor,
                  [&](double fraction) { request.report(fraction, "shade"); });
  Image image = request.wants_colours ? painter.paint(statistics_) : painter.look(statistics_);
  statistics_.shade_ms += shade_time.milliseconds();
  return image;
}

}  // namespace facemap
