#include "render/whole_picture.h"

#include <bit>
#include <cmath>
#include <limits>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "picture/lit_points.h"
#include "picture/nearest_faces.h"
#include "picture/sample_grid.h"
#include "picture/seen_points.h"
#include "render/shade_picture.h"
#include "render/stopwatch.h"

namespace facemap {
namespace {

std::vector<Vector> positions_of(const std::vector<Light>& lights) {
  std::vector<Vector> positions;
  positions.reserve(lights.size());
  for (const Light& light : lights) positions.push_back(light.position);
  return positions;
}

// Masks of points, put where their samples lie.
std::vector<std::uint8_t> masks_by_sample(const SeenPoints& seen, std::size_t samples) {
  const std::size_t stride = seen.stride;
  std::vector<std::uint8_t> masks(samples * stride);
  const std::vector<std::uint32_t>& numbers = seen.points.samples;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    for (std::size_t k = 0; k < stride; ++k) masks[numbers[i] * stride + k] = seen.masks[i * stride + k];
  }
  return masks;
}

// The mean of each pixel's samples, in the order of rows and columns.
std::vector<Color> mean_of_samples(const SampleGrid& grid, const std::vector<Color>& colors, const Executor& executor) {
  const auto width = static_cast<std::size_t>(grid.projection.width());
  const auto height = static_cast<std::size_t>(grid.projection.height());
  const auto per_side = static_cast<std::size_t>(grid.per_side);
  const double count = static_cast<double>(per_side * per_side);
  std::vector<Color> means(width * height);
  executor.for_each(height, [&](std::size_t y, int) {
    for (std::size_t x = 0; x < width; ++x) {
      double r = 0, g = 0, b = 0;
      for (std::size_t j = 0; j < per_side; ++j) {
        const Color* row = &colors[((y * per_side + j) * width + x) * per_side];
        for (std::size_t i = 0; i < per_side; ++i) {
          r += row[i].r;
          g += row[i].g;
          b += row[i].b;
        }
      }
      means[y * width + x] = {static_cast<float>(r / count), static_cast<float>(g / count),
                              static_cast<float>(b / count)};
    }
  });
  return means;
}

// As Camera::nearest gives it.
std::vector<float> depths_of(const Scene& scene, const SampleGrid& grid, const std::vector<FaceId>& faces,
                             const Executor& executor) {
  const auto columns = static_cast<std::size_t>(grid.columns());
  std::vector<float> depths(faces.size(), std::numeric_limits<float>::infinity());
  executor.for_each(static_cast<std::size_t>(grid.rows()), [&](std::size_t row, int) {
    for (std::size_t column = 0; column < columns; ++column) {
      const FaceId face = faces[row * columns + column];
      if (face == kNoFace) continue;
      const Vector& K = grid.frame.position();
      const Vector d = grid.direction(static_cast<int>(column), static_cast<int>(row));
      const Triangle triangle = triangle_of(scene, static_cast<std::uint32_t>(face));
      const TruePoint point{K, d, triangle, side(triangle, K)};
      const double length = std::sqrt(double(d.x) * d.x + double(d.y) * d.y + double(d.z) * d.z);
      depths[row * columns + column] = static_cast<float>(sharp_ray_parameter(point, ray_parameter(point)) * length);
    }
  });
  return depths;
}

}  // namespace

/// What the samples of a grid see, and which lights reach it.
struct WholePicture::Seen {
  SampleGrid grid;
  std::vector<FaceId> faces;  // one a sample
  SeenPoints points;          // masks: the lights that reach them
};

WholePicture::WholePicture(const Scene& scene, const View& view, const std::vector<Light>& lights,
                           const Renderer::Options& options, const Executor& executor, TransposedState& state,
                           const std::vector<PointLight>* lists, Renderer::Statistics& statistics, Report report)
    : scene_(scene),
      view_(view),
      lights_(lights),
      options_(options),
      executor_(executor),
      state_(state),
      lists_(lists),
      statistics_(statistics),
      report_(std::move(report)) {
  state_.scratch.resize(static_cast<std::size_t>(executor.threads()));
}

WholePicture::Seen WholePicture::see(int per_side) {
  const SampleGrid grid{SpaceVector::looking_at(view_.position, view_.look_at, view_.up),
                        Projection(view_.projection, view_.field_angle, options_.width, options_.height), per_side};
  const Stopwatch camera_time;
  report_(0, "camera map");
  NearestFaces nearest = find_nearest_faces(scene_, grid, executor_, &statistics_.camera_tests);
  statistics_.camera_queries += grid.count();
  SeenPoints seen = find_seen_points(scene_, grid, nearest, positions_of(lights_), executor_);
  statistics_.camera_map_ms += camera_time.milliseconds();
  ask_lights(grid, seen);
  return {grid, std::move(nearest.faces), std::move(seen)};
}

void WholePicture::ask_lights(const SampleGrid& grid, SeenPoints& seen) {
  report_(0.2, "light maps");
  const Stopwatch closed_time;
  if (lists_ == nullptr && !state_.closed) state_.closed = std::make_unique<ClosedParts>(scene_, executor_);
  statistics_.light_maps_ms += closed_time.milliseconds();

  report_(0.3, "shade");
  const Stopwatch light_time;
  MovedPoints moved = find_moved_points(scene_, grid, seen, lights_, options_, executor_);
  for (const std::uint8_t mask : seen.masks) statistics_.light_queries += static_cast<unsigned>(std::popcount(mask));
  statistics_.light_queries += moved.positions.size() * lights_.size();
  Counters& counters = statistics_.light_tests;
  if (lists_ != nullptr) {
    clear_blocked_by_lists(*lists_, scene_, grid, executor_, seen, counters);
    clear_blocked_by_lists(*lists_, moved.positions, seen.stride, executor_, moved.masks, counters);
  } else {
    const std::vector<Vector> lights = positions_of(lights_);
    const LightWork work{scene_,    lights,         state_.closed.get(),
                         executor_, state_.scratch, [this](double share) { report_(0.3 + 0.5 * share, "shade"); }};
    clear_blocked(work, grid, seen, counters);
    clear_blocked(work, moved.points, moved.positions, seen.stride, moved.masks, counters);
  }
  put_back_masks(moved, seen);
  statistics_.shade_ms += light_time.milliseconds();
}

Image WholePicture::look() {
  Seen seen = see(options_.samples);
  Image image;
  image.width = seen.grid.columns();
  image.height = seen.grid.rows();
  image.light_count = static_cast<int>(lights_.size());
  image.lights = masks_by_sample(seen.points, seen.grid.count());
  image.ids = std::move(seen.faces);
  return image;
}

Image WholePicture::paint() {
  Image image;
  image.width = options_.width;
  image.height = options_.height;
  image.light_count = static_cast<int>(lights_.size());
  Seen seen = see(options_.samples);
  const Stopwatch shade_time;
  report_(0.8, "shade");
  std::vector<Color> colors(seen.grid.count(), options_.background);
  shade_points(scene_, seen.grid, seen.points, lights_, options_, executor_, colors);
  image.pixels = options_.samples == 1 ? std::move(colors) : mean_of_samples(seen.grid, colors, executor_);
  statistics_.shade_ms += shade_time.milliseconds();

  report_(1, "shade");
  // Planes always hold the ray through the pixel's centre.
  if (!options_.want_ids && !options_.want_depths && !options_.want_lights) return image;
  if (options_.samples != 1) seen = see(1);
  if (options_.want_depths) image.depths = depths_of(scene_, seen.grid, seen.faces, executor_);
  if (options_.want_lights) image.lights = masks_by_sample(seen.points, seen.grid.count());
  if (options_.want_ids) image.ids = std::move(seen.faces);
  return image;
}

}  // namespace facemap
