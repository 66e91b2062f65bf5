#include "render/painter.h"

#include <algorithm>

namespace facemap {
namespace {

constexpr int kRowsPerReport = 8;

}  // namespace

Painter::Painter(const Camera& camera, std::span<const PointLight> lights, const Renderer::Options& options,
                 const MaterialTable* materials, const Executor& executor, Report report)
    : camera_(camera), options_(options), executor_(executor), report_(std::move(report)) {
  image_.width = options.width;
  image_.height = options.height;
  image_.light_count = static_cast<int>(lights.size());
  const std::size_t pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  const bool edges = options.sampling == Renderer::Sampling::Edges;
  image_.pixels.resize(pixels);
  if (options.planes.has(Plane::Id) || edges) image_.ids.resize(pixels);
  if (options.planes.has(Plane::Lights) || edges)
    image_.lights.resize(pixels * static_cast<std::size_t>(image_.light_bytes()));
  for (int i = 0; i < executor.threads(); ++i) {
    workers_.push_back(std::make_unique<Worker>(camera, lights, options, materials));
  }
}

Image Painter::paint(Renderer::Statistics& statistics) {
  if (options_.sampling == Renderer::Sampling::Edges) {
    for_each_row(0, 0.5, [&](int y, Worker& worker) { paint_row(y, 1, worker); });
    for_each_row(0.5, 0.5, [&](int y, Worker& worker) { upsample_edges(y, worker); });
    if (!options_.planes.has(Plane::Id)) image_.ids = {};
    if (!options_.planes.has(Plane::Lights)) image_.lights = {};
  } else {
    for_each_row(0, 1, [&](int y, Worker& worker) { paint_row(y, options_.samples, worker); });
  }
  for (const std::unique_ptr<Worker>& worker : workers_) {
    statistics.camera_queries += worker->statistics.camera_queries;
    statistics.light_queries += worker->statistics.light_queries;
    statistics.upsampled_pixels += worker->statistics.upsampled_pixels;
    statistics.camera_tests += worker->statistics.camera_tests;
    statistics.light_tests += worker->statistics.light_tests;
  }
  return std::move(image_);
}

void Painter::for_each_row(double done_before, double share,
                           const std::function<void(int y, Worker& worker)>& paint_row) {
  rows_done_ = 0;
  executor_.for_each(static_cast<std::size_t>(image_.height), [&](std::size_t y, int worker) {
    paint_row(static_cast<int>(y), *workers_[static_cast<std::size_t>(worker)]);
    const std::scoped_lock lock(reporting_);
    if (rows_done_++ % kRowsPerReport == 0) report_(done_before + share * rows_done_ / image_.height);
  });
}

// Planes always hold the ray through the pixel's centre.
void Painter::paint_row(int y, int samples, Worker& worker) {
  const bool centre_is_sampled = samples == 1;
  const bool wants_planes = !image_.ids.empty() || !image_.lights.empty();
  for (int x = 0; x < image_.width; ++x) {
    const std::size_t pixel = index(x, y);
    if (!centre_is_sampled) image_.pixels[pixel] = mean_of_grid(x, y, samples, worker);
    if (!centre_is_sampled && !wants_planes) continue;
    worker.shader.shade(MapPoint(x + 0.5, y + 0.5), 1, worker.sample);
    if (centre_is_sampled) image_.pixels[pixel] = worker.sample.color;
    store_planes(pixel, worker.sample);
  }
}

void Painter::store_planes(std::size_t pixel, const Sample& sample) {
  if (!image_.ids.empty()) image_.ids[pixel] = sample.face;
  if (!image_.lights.empty()) {
    std::copy(sample.lights.begin(), sample.lights.end(),
              image_.lights.begin() + static_cast<std::ptrdiff_t>(pixel * sample.lights.size()));
  }
}

Color Painter::mean_of_grid(int x, int y, int samples, Worker& worker) {
  double r = 0, g = 0, b = 0;
  for (int j = 0; j < samples; ++j) {
    for (int i = 0; i < samples; ++i) {
      worker.shader.shade(MapPoint(x + (i + 0.5) / samples, y + (j + 0.5) / samples), 1.0 / samples,
                          worker.grid_sample);
      r += worker.grid_sample.color.r;
      g += worker.grid_sample.color.g;
      b += worker.grid_sample.color.b;
    }
  }
  const double count = samples * samples;
  return {static_cast<float>(r / count), static_cast<float>(g / count), static_cast<float>(b / count)};
}

// Wang 2022, sec. 2.3, Fig. 3: only the pixels that may hold an edge are divided.
void Painter::upsample_edges(int y, Worker& worker) {
  for (int x = 0; x < image_.width; ++x) {
    if (!may_hold_edge(x, y)) continue;
    ++worker.statistics.upsampled_pixels;
    image_.pixels[index(x, y)] = mean_of_grid(x, y, options_.samples, worker);
  }
}

// The pixel's own list of the camera's map holds another candidate, or a neighbour shows another face (so perhaps
// another normal) or other lights.
bool Painter::may_hold_edge(int x, int y) const {
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

bool Painter::same_lights(std::size_t i, std::size_t j) const {
  const std::size_t bytes = static_cast<std::size_t>(image_.light_bytes());
  const std::uint8_t* lights = image_.lights.data();
  return std::equal(lights + i * bytes, lights + (i + 1) * bytes, lights + j * bytes);
}

}  // namespace facemap
