#include <facemap/error.h>
#include <facemap/renderer.h>

#include <chrono>
#include <cmath>

#include "render/painter.h"
#include "render/shade.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

class Stopwatch {
 public:
  double milliseconds() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

bool is_valid(const Color& c) {
  return c.r >= 0 && c.g >= 0 && c.b >= 0 && std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

void validate(const Renderer::Options& options, const std::vector<Light>& lights) {
  if (options.samples < 1 || options.samples > 16) throw Error("samples a side of a pixel must be 1 to 16");
  if (!is_valid(options.background)) throw Error("background must be finite and not negative");
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const Vector& p = lights[i].position;
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw Error("position of light " + std::to_string(i) + " is not finite");
    }
    if (!is_valid(lights[i].color) || !(lights[i].intensity >= 0) || !std::isfinite(lights[i].intensity)) {
      throw Error("colour and intensity of light " + std::to_string(i) + " must be finite and not negative");
    }
  }
}

}  // namespace

Renderer::Renderer(const Scene& scene, const View& view, std::vector<Light> lights, const Options& options)
    : scene_(&scene), view_(view), lights_(std::move(lights)), options_(options) {
  const FloatingPointMode mode;
  validate(options_, lights_);
  Projection(view.projection, view.field_angle, options.width, options.height);
  SpaceVector::looking_at(view.position, view.look_at, view.up);
}

Image Renderer::render(const Progress& progress) {
  const FloatingPointMode mode;
  statistics_ = Statistics();
  const auto report = [&](double fraction, const char* phase) {
    if (progress && !progress(fraction, phase)) throw Error("stopped");
  };

  report(0, "camera map");
  const Stopwatch camera_time;
  Camera::Options camera_options;
  camera_options.projection = view_.projection;
  camera_options.field_angle = view_.field_angle;
  camera_options.width = options_.width;
  camera_options.height = options_.height;
  camera_options.builder = options_.builder;
  const Camera camera(*scene_, SpaceVector::looking_at(view_.position, view_.look_at, view_.up), camera_options);
  statistics_.camera_map_ms = camera_time.milliseconds();
  statistics_.map_bytes = camera.memory_bytes();

  const Stopwatch light_time;
  std::vector<PointLight> lights;
  lights.reserve(lights_.size());
  for (const Light& light : lights_) {
    report(static_cast<double>(lights.size()) / static_cast<double>(lights_.size()), "light maps");
    PointLight::Options light_options;
    light_options.builder = options_.builder;
    lights.emplace_back(*scene_, light.position, light_options);
    lights.back().color = light.color;
    lights.back().intensity = light.intensity;
    statistics_.map_bytes += lights.back().memory_bytes();
  }
  statistics_.light_maps_ms = light_time.milliseconds();

  const Stopwatch shade_time;
  Shader shader(camera, lights, options_, statistics_);
  Image image = Painter(camera, shader, options_, static_cast<int>(lights.size()), statistics_, [&](double fraction) {
                  report(fraction, "shade");
                }).paint();
  statistics_.shade_ms = shade_time.milliseconds();
  return image;
}

Image Renderer::look(const Progress& progress) {
  const Options options = options_;
  options_.sampling = Sampling::Grid;
  options_.samples = 1;
  options_.normals = Normals::Flat;
  options_.want_ids = options_.want_lights = true;
  options_.want_depths = false;
  Image image = render(progress);
  options_ = options;
  image.pixels = {};
  return image;
}

void Renderer::set_view(const View& view) {
  const FloatingPointMode mode;
  Projection(view.projection, view.field_angle, options_.width, options_.height);
  SpaceVector::looking_at(view.position, view.look_at, view.up);
  view_ = view;
}

}  // namespace facemap
