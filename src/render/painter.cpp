#include "render/painter.h"

#include <algorithm>

namespace facemap {
namespace {

constexpr int kRowsPerReport = 8;

}  // namespace

Painter::Painter(const Camera& camera, Shader& shader, const Renderer::Options& options, int light_count,
                 Renderer::Statistics& statistics, Report report)
    : camera_(camera), shader_(shader), options_(options), statistics_(statistics), report_(std::move(report)) {
  image_.width = options.width;
  image_.height = options.height;
  image_.light_count = light_count;
  const std::size_t pixels = static_cast<std::size_t>(options.width) * static_cast<std::size_t>(options.height);
  const bool edges = options.sampling == Renderer::Sampling::Edges;
  image_.pixels.resize(pixels);
  if (options.want_ids || edges) image_.ids.resize(pixels);
  if (options.want_depths) image_.depths.resize(pixels);
  if (options.want_lights || edges) image_.lights.resize(pixels * static_cast<std::size_t>(image_.light_bytes()));
}

Image Painter::paint() {
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

// Planes always hold the ray through the pixel's centre.
void Painter::paint_rows(int samples, double share) {
  const bool centre_is_sampled = samples == 1;
  const bool wants_planes = !image_.ids.empty() || !image_.depths.empty() || !image_.lights.empty();
  Sample sample;
  for (int y = 0; y < image_.height; ++y) {
    if (y % kRowsPerReport == 0) report_(share * y / image_.height);
    for (int x = 0; x < image_.width; ++x) {
      const std::size_t pixel = index(x, y);
      if (!centre_is_sampled) image_.pixels[pixel] = mean_of_grid(x, y, samples);
      if (!centre_is_sampled && !wants_planes) continue;
      shader_.shade(MapPoint(x + 0.5, y + 0.5), sample);
      if (centre_is_sampled) image_.pixels[pixel] = sample.color;
      store_planes(pixel, sample);
    }
  }
}

void Painter::store_planes(std::size_t pixel, const Sample& sample) {
  if (!image_.ids.empty()) image_.ids[pixel] = sample.face;
  if (!image_.depths.empty()) image_.depths[pixel] = sample.depth;
  if (!image_.lights.empty()) {
    std::copy(sample.lights.begin(), sample.lights.end(),
              image_.lights.begin() + static_cast<std::ptrdiff_t>(pixel * sample.lights.size()));
  }
}

Color Painter::mean_of_grid(int x, int y, int samples) {
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
void Painter::upsample_edges() {
  for (int y = 0; y < image_.height; ++y) {
    if (y % kRowsPerReport == 0) report_(0.5 + 0.5 * y / image_.height);
    for (int x = 0; x < image_.width; ++x) {
      if (!may_hold_edge(x, y)) continue;
      ++statistics_.upsampled_pixels;
      image_.pixels[index(x, y)] = mean_of_grid(x, y, options_.samples);
    }
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
