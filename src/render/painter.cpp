#include "render/painter.h"

#include <algorithm>

#include "render/crop_margin.h"
#include "render/filtered_rows.h"
#include "render/picture_frame.h"

namespace facemap {
namespace {

constexpr int kRowsPerReport = 8;

constexpr int kRowsOfBand = 16;  // of pixels whose samples are kept until they are filtered

}  // namespace

Painter::Painter(const View& view, const Eye& eye, std::span<const simd::LightSource> lights,
                 const ListsOfLights& lists, const Renderer::Options& options, const MaterialTable* materials,
                 const Executor& executor, Report report)
    : eye_(eye),
      options_(options),
      executor_(executor),
      report_(std::move(report)),
      made_(pixels_about_crop(options)),
      pieces_(PicturePieces::of(view, made_)) {
  const bool edges = options.sampling == Renderer::Sampling::Edges;
  image_.width = made_.width;
  image_.height = made_.height;
  image_.light_count = static_cast<int>(lights.size());
  const std::size_t pixels = static_cast<std::size_t>(made_.width) * static_cast<std::size_t>(made_.height);
  image_.pixels.resize(pixels);
  if (options.planes.has(Plane::Id) || edges) image_.ids.resize(pixels);
  if (options.planes.has(Plane::Lights) || edges)
    image_.lights.resize(pixels * static_cast<std::size_t>(image_.light_bytes()));
  for (int i = 0; i < executor.threads(); ++i) {
    workers_.push_back(std::make_unique<Worker>(eye, lights, lists, options, materials));
  }
}

Image Painter::paint(Renderer::Statistics& statistics) {
  const bool by_edges = options_.sampling == Renderer::Sampling::Edges;
  const bool is_box = options_.filter == Renderer::Filter::Box;
  if (by_edges) for_each_row(0, 0.5, [&](int y, Worker& worker) { paint_row(y, 1, worker); });
  if (!is_box) {
    filter_samples(by_edges ? 0.5 : 0);
  } else if (by_edges) {
    for_each_row(0.5, 0.5, [&](int y, Worker& worker) { upsample_edges(y, worker); });
  } else {
    for_each_row(0, 1, [&](int y, Worker& worker) { paint_row(y, options_.samples, worker); });
  }
  if (!options_.planes.has(Plane::Id)) image_.ids = {};
  if (!options_.planes.has(Plane::Lights)) image_.lights = {};
  add_counts(statistics);
  return cut(image_, made_, made_pixels(options_));
}

// Each pixel from the samples about it: a pixel that is not divided counts as so many equal ones.
void Painter::filter_samples(double done_before) {
  const int n = options_.samples;
  FilteredRows filtered(PixelFilter(options_.filter, options_.filter_width, n), made_.width, made_.height, pieces_);
  const std::size_t row_length = static_cast<std::size_t>(made_.width) * static_cast<std::size_t>(n);
  std::vector<Color> samples, pixels(image_.pixels.size());
  for (int first = 0; first < made_.height; first += kRowsOfBand) {
    const int rows = std::min(kRowsOfBand, made_.height - first);
    samples.resize(row_length * static_cast<std::size_t>(rows * n));
    executor_.for_each(static_cast<std::size_t>(rows), [&](std::size_t row, int worker) {
      put_samples(first + static_cast<int>(row), *workers_[static_cast<std::size_t>(worker)],
                  samples.data() + row * static_cast<std::size_t>(n) * row_length);
    });
    filtered.add(rows * n, samples, executor_, pixels.data());
    report_(done_before + (1 - done_before) * (first + rows) / made_.height);
  }
  image_.pixels = std::move(pixels);
}

// The samples of a row of pixels, row by row.
void Painter::put_samples(int y, Worker& worker, Color* samples) {
  const int n = options_.samples;
  const bool by_edges = options_.sampling == Renderer::Sampling::Edges;
  const std::size_t row_length = static_cast<std::size_t>(made_.width) * static_cast<std::size_t>(n);
  for (int x = 0; x < made_.width; ++x) {
    const bool is_divided = !by_edges || may_hold_edge(x, y, worker);
    if (by_edges && is_divided) ++worker.statistics.upsampled_pixels;
    for (int j = 0; j < n; ++j) {
      Color* const row = samples + static_cast<std::size_t>(j) * row_length + static_cast<std::size_t>(x * n);
      for (int i = 0; i < n; ++i)
        row[i] = is_divided ? sample_of_grid(x, y, i, j, n, worker) : image_.pixels[index(x, y)];
    }
    if (!by_edges && (!image_.ids.empty() || !image_.lights.empty())) {
      worker.shader.shade(MapPoint(made_.x + x + 0.5, made_.y + y + 0.5), 1, worker.sample);
      store_planes(index(x, y), worker.sample);
    }
  }
}

Image Painter::look(Renderer::Statistics& statistics) {
  image_.width = made_.width * options_.samples;
  image_.height = made_.height * options_.samples;
  const std::size_t samples = static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height);
  image_.pixels = {};
  image_.ids.resize(samples);
  image_.lights.resize(samples * static_cast<std::size_t>(image_.light_bytes()));
  for_each_row(0, 1, [&](int y, Worker& worker) { look_at_row(y, worker); });
  add_counts(statistics);
  return std::move(image_);
}

// Places as in mean_of_grid.
void Painter::look_at_row(int y, Worker& worker) {
  const int n = options_.samples;
  for (int x = 0; x < image_.width; ++x) {
    const MapPoint place(made_.x + x / n + (x % n + 0.5) / n, made_.y + y / n + (y % n + 0.5) / n);
    worker.shader.shade(place, 1.0 / n, worker.sample);
    store_planes(index(x, y), worker.sample);
  }
}

void Painter::add_counts(Renderer::Statistics& statistics) const {
  for (const std::unique_ptr<Worker>& worker : workers_) {
    statistics.camera_queries += worker->statistics.camera_queries;
    statistics.light_queries += worker->statistics.light_queries;
    statistics.upsampled_pixels += worker->statistics.upsampled_pixels;
    statistics.camera_tests += worker->statistics.camera_tests;
    statistics.light_tests += worker->statistics.light_tests;
  }
}

// Whether it is of those that are asked for.
bool Painter::is_made(int x, int y) const {
  const PixelBox part = made_pixels(options_);
  const int column = made_.x + x - part.x, row = made_.y + y - part.y;
  return column >= 0 && column < part.width && row >= 0 && row < part.height;
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
    worker.shader.shade(MapPoint(made_.x + x + 0.5, made_.y + y + 0.5), 1, worker.sample);
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

MapPoint Painter::place_in_grid(int x, int y, int i, int j, int samples) const {
  return {made_.x + x + (i + 0.5) / samples, made_.y + y + (j + 0.5) / samples};
}

const Color& Painter::sample_of_grid(int x, int y, int i, int j, int samples, Worker& worker) {
  worker.shader.shade(place_in_grid(x, y, i, j, samples), 1.0 / samples, worker.grid_sample);
  return worker.grid_sample.color;
}

Color Painter::mean_of_grid(int x, int y, int samples, Worker& worker) {
  double r = 0, g = 0, b = 0;
  for (int j = 0; j < samples; ++j) {
    for (int i = 0; i < samples; ++i) {
      const Color& color = sample_of_grid(x, y, i, j, samples, worker);
      r += color.r;
      g += color.g;
      b += color.b;
    }
  }
  const double count = samples * samples;
  return {static_cast<float>(r / count), static_cast<float>(g / count), static_cast<float>(b / count)};
}

// Wang 2022, sec. 2.3, Fig. 3: only the pixels that may hold an edge are divided.
void Painter::upsample_edges(int y, Worker& worker) {
  for (int x = 0; x < image_.width; ++x) {
    if (!is_made(x, y) || !may_hold_edge(x, y, worker)) continue;
    ++worker.statistics.upsampled_pixels;
    image_.pixels[index(x, y)] = mean_of_grid(x, y, options_.samples, worker);
  }
}

// The pixel's own list of the camera's map holds another candidate or a face with holes (without lists: a sample shows
// another face), or a neighbour shows another face (so perhaps another normal) or other lights.
bool Painter::may_hold_edge(int x, int y, Worker& worker) const {
  const std::size_t own = index(x, y);
  for (const std::uint32_t face : eye_.faces_at(made_.x + x, made_.y + y)) {
    if (static_cast<FaceId>(face) != image_.ids[own]) return true;
  }
  if (!eye_.cut_outs_at(made_.x + x, made_.y + y).empty()) return true;
  for (int v = std::max(0, y - 1); v <= std::min(image_.height - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(image_.width - 1, x + 1); ++u) {
      if (!pieces_.are_one(x, y, u, v)) continue;
      const std::size_t other = index(u, v);
      if (image_.ids[other] != image_.ids[own] || !same_lights(own, other)) return true;
    }
  }
  return !eye_.has_lists() && shows_another_face(x, y, worker);
}

// One of the pixel's samples, than its centre.
bool Painter::shows_another_face(int x, int y, Worker& worker) const {
  const int n = options_.samples;
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      ++worker.statistics.camera_queries;
      const Eye::Ray ray = eye_.ray(place_in_grid(x, y, i, j, n));
      if (eye_.nearest(ray, &worker.statistics.camera_tests).face != image_.ids[index(x, y)]) return true;
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
