#include "render/shade_picture.h"

#include <algorithm>
#include <memory>

#include "picture/place_points.h"
#include "render/shade_batch.h"

namespace facemap {
namespace {

// Points that a task takes at a time: whole batches.
constexpr std::size_t kChunk = 16 * simd::kSeenBatch;

std::size_t chunks_of(std::size_t count) { return (count + kChunk - 1) / kChunk; }

std::vector<simd::LightSource> sources_of(const std::vector<Light>& lights) {
  std::vector<simd::LightSource> sources;
  for (const Light& light : lights) {
    sources.push_back({{light.position.x, light.position.y, light.position.z},
                       {light.color.r, light.color.g, light.color.b},
                       light.intensity});
  }
  return sources;
}

// Calls task(batch, first point) for all batches of the seen points; batches of one chunk in order, by one thread.
template <class Task>
void for_each_batch(const Scene& scene, const SampleGrid& grid, const AskedPoints& points, bool smooth,
                    const Executor& executor, const Task& task) {
  const RayTable rays(grid);
  std::vector<std::unique_ptr<ShadeBatch>> batches;
  for (int i = 0; i < executor.threads(); ++i) {
    batches.push_back(std::make_unique<ShadeBatch>(scene, grid.frame.position(), rays, smooth));
  }
  executor.for_each(chunks_of(points.size()), [&](std::size_t chunk, int worker) {
    ShadeBatch& batch = *batches[static_cast<std::size_t>(worker)];
    const std::size_t end = std::min(points.size(), (chunk + 1) * kChunk);
    for (std::size_t first = chunk * kChunk; first < end; first += simd::kSeenBatch) {
      batch.take(points, first, std::min(simd::kSeenBatch, end - first));
      task(batch, first, chunk);
    }
  });
}

}  // namespace

void put_back_masks(const MovedPoints& moved, SeenPoints& seen) {
  const std::size_t stride = seen.stride;
  for (std::size_t i = 0; i < moved.owners.size(); ++i) {
    std::copy_n(moved.masks.data() + i * stride, stride, seen.masks.data() + moved.owners[i] * stride);
  }
}

MovedPoints find_moved_points(const Scene& scene, const SampleGrid& grid, SeenPoints& seen,
                              const std::vector<Light>& lights, const Renderer::Options& options,
                              const Executor& executor) {
  MovedPoints moved;
  if (options.normals == Renderer::Normals::Flat || !options.shadow_terminator_fix) return moved;

  std::vector<std::vector<MovedPoint>> found(chunks_of(seen.points.size()));
  for_each_batch(
      scene, grid, seen.points, true, executor,
      [&](ShadeBatch& batch, std::size_t first, std::size_t chunk) { batch.find_moved(first, found[chunk]); });
  std::size_t count = 0;
  for (const auto& some : found) count += some.size();
  moved.positions.reserve(count);
  moved.owners.reserve(count);
  for (auto& some : found) {
    for (const MovedPoint& point : some) {
      moved.positions.push_back(point.position);
      moved.owners.push_back(point.owner);
    }
    some = {};
  }
  moved.points = place_points(moved.positions);
  moved.points.samples.resize(count);
  moved.masks.resize(count * seen.stride);
  for (std::size_t i = 0; i < count; ++i) {
    moved.points.samples[i] = seen.points.samples[moved.owners[i]];
    std::fill_n(seen.masks.begin() + static_cast<std::ptrdiff_t>(moved.owners[i] * seen.stride), seen.stride, 0);
    for (std::size_t l = 0; l < lights.size(); ++l) {
      moved.masks[i * seen.stride + l / 8] |= static_cast<std::uint8_t>(1u << (l % 8));
    }
  }
  return moved;
}

void shade_points(const Scene& scene, const SampleGrid& grid, const SeenPoints& seen, const std::vector<Light>& lights,
                  const Renderer::Options& options, const Executor& executor, std::span<Color> colors) {
  const std::vector<simd::LightSource> sources = sources_of(lights);
  const bool inverse_square = options.falloff == Renderer::Falloff::InverseSquare;
  for_each_batch(scene, grid, seen.points, options.normals == Renderer::Normals::Smooth, executor,
                 [&](ShadeBatch& batch, std::size_t first, std::size_t) {
                   batch.shade(sources, inverse_square, seen.masks.data() + first * seen.stride, seen.stride);
                   batch.store_colors(seen.points.samples.data() + first, colors);
                 });
}

}  // namespace facemap
