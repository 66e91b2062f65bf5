#include <facemap/error.h>
#include <facemap/renderer.h>

#include <chrono>
#include <cmath>

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
    if (!is_valid(lights[i].color) || !(lights[i].intensity >= 0) || !std::isfinite(lights[i].intensity)) {
      throw Error("colour and intensity of light " + std::to_string(i) + " must be finite and not negative");
    }
  }
}

/// Fills an image from a shader: the loop over pixels, and which of them get more than one sample.
class Painter {
 public:
  Painter(const Camera& camera, Shader& shader, const Renderer::Options& options, std::size_t light_count,
          Renderer::Statistics& statistics, const std::function<void(double)>& report)
      : camera_(camera), shader_(shader), options_(options), statistics_(statistics), report_(report) {
    image_.width = options.width;
    image_.height = options.height;
    image_.light_count = static_cast<int>(light_count);
    const std::size_t pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
    const bool edges = options.sampling == Renderer::Sampling::Edges;
    image_.pixels.resize(pixels);
    if (options.want_ids || edges) image_.ids.resize(pixels);
    if (options.want_depths) image_.depths.resize(pixels);
    if (options.want_lights || edges) image_.lights.resize(pixels * static_cast<std::size_t>(image_.light_bytes()));
  }

  Image paint() {
    if (options_.sampling == Renderer::Sampling::Edges) {
      paint_rows(1, 0.5);
      upsample_edges();
      if (!options_.want_ids) image_.ids = {};
      if (!options_.want_lights) image_.lights = {};
    } else {
      paint_rows(options_.samples, 1);
    }
    return std::move(image_);
  }

 private:
  // Planes always hold the ray through the pixel's centre.
  void paint_rows(int samples, double share) {
    const bool centre_is_sampled = samples == 1;
    const bool wants_planes = !image_.ids.empty() || !image_.depths.empty() || !image_.lights.empty();
    Sample sample;
    for (int y = 0; y < image_.height; ++y) {
      if (y % 8 == 0) report_(share * y / image_.height);
      for (int x = 0; x < image_.width; ++x) {
        const std::size_t i = index(x, y);
        if (!centre_is_sampled) image_.pixels[i] = mean_of_grid(x, y, samples);
        if (!centre_is_sampled && !wants_planes) continue;
        shader_.shade(MapPoint(x + 0.5, y + 0.5), sample);
        if (centre_is_sampled) image_.pixels[i] = sample.color;
        store_planes(i, sample);
      }
    }
  }

  void store_planes(std::size_t i, const Sample& sample) {
    if (!image_.ids.empty()) image_.ids[i] = sample.face;
    if (!image_.depths.empty()) image_.depths[i] = sample.depth;
    if (!image_.lights.empty()) {
      std::copy(sample.lights.begin(), sample.lights.end(),
                image_.lights.begin() + static_cast<std::ptrdiff_t>(i * sample.lights.size()));
    }
  }

  Color mean_of_grid(int x, int y, int samples) {
    double r = 0, g = 0, b = 0;
    for (int j = 0; j < samples; ++j) {
      for (int i = 0; i < samples; ++i) {
        shader_.shade(MapPoint(x + (i + 0.5) / samples, y + (j + 0.5) / samples), grid_sample_);
        r += grid_sample_.color.r;
        g += grid_sample_.color.g;
        b += grid_sample_.color.b;
      }
    }
    const double count = samples * samples;
    return {static_cast<float>(r / count), static_cast<float>(g / count), static_cast<float>(b / count)};
  }

  // Wang 2022, sec. 2.3, Fig. 3: only the pixels that may hold an edge are divided.
  void upsample_edges() {
    for (int y = 0; y < image_.height; ++y) {
      if (y % 8 == 0) report_(0.5 + 0.5 * y / image_.height);
      for (int x = 0; x < image_.width; ++x) {
        if (!may_hold_edge(x, y)) continue;
        ++statistics_.upsampled_pixels;
        image_.pixels[index(x, y)] = mean_of_grid(x, y, options_.samples);
      }
    }
  }

  // A neighbour shows another face (so perhaps another normal) or other lights, or the pixel's own list of the
  // camera's map holds another candidate.
  bool may_hold_edge(int x, int y) const {
    const std::size_t own = index(x, y);
    for (const std::uint32_t face : camera_.faces_at(x, y)) {
      if (static_cast<FaceId>(face) != image_.ids[own]) return true;
    }
    for (int v = std::max(0, y - 1); v <= std::min(image_.height - 1, y + 1); ++v) {
      for (int u = std::max(0, x - 1); u <= std::min(image_.width - 1, x + 1); ++u) {
        const std::size_t other = index(u, v);
        if (image_.ids[other] != image_.ids[own] || !same_lights(own, other)) return true;
      }
    }
    return false;
  }

  bool same_lights(std::size_t i, std::size_t j) const {
    const std::size_t bytes = static_cast<std::size_t>(image_.light_bytes());
    const std::uint8_t* lights = image_.lights.data();
    return std::equal(lights + i * bytes, lights + (i + 1) * bytes, lights + j * bytes);
  }

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x);
  }

  const Camera& camera_;
  Shader& shader_;
  const Renderer::Options& options_;
  Renderer::Statistics& statistics_;
  const std::function<void(double)>& report_;
  Sample grid_sample_;
  Image image_;
};

}  // namespace

Renderer::Renderer(const Scene& scene, const View& view, std::vector<Light> lights, const Options& options)
    : scene_(&scene), view_(view), lights_(std::move(lights)), options_(options) {
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
  const std::function<void(double)> report_shading = [&](double fraction) { report(fraction, "shade"); };
  Image image = Painter(camera, shader, options_, lights.size(), statistics_, report_shading).paint();
  statistics_.shade_ms = shade_time.milliseconds();
  return image;
}

}  // namespace facemap
