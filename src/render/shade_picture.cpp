#include "render/shade_picture.h"

#include <algorithm>
#include <memory>

#include "render/light_sources.h"
#include "render/shade_batch.h"

namespace facemap {
namespace {

// Points that a task takes at a time: whole batches.
constexpr std::size_t kChunk = 16 * simd::kSeenBatch;

std::size_t chunks_of(std::size_t count) { return (count + kChunk - 1) / kChunk; }

// Calls task(batch, first point, one past the last, chunk) for all chunks of the seen points.
template <class Task>
void for_each_chunk(const Scene& scene, const SampleGrid& grid, const AskedPoints& points, bool smooth,
                    const MaterialTable* materials, const Executor& executor, const Task& task) {
  const RayTable rays(grid);
  std::vector<std::unique_ptr<ShadeBatch>> batches;
  for (int i = 0; i < executor.threads(); ++i) {
    batches.push_back(std::make_unique<ShadeBatch>(scene, grid, rays, smooth, materials));
  }
  executor.for_each(chunks_of(points.size()), [&](std::size_t chunk, int worker) {
    ShadeBatch& batch = *batches[static_cast<std::size_t>(worker)];
    task(batch, chunk * kChunk, std::min(points.size(), (chunk + 1) * kChunk), chunk);
  });
}

// A bit set for each light.
std::vector<std::uint8_t> full_mask(std::size_t light_count) {
  std::vector<std::uint8_t> mask((light_count + 7) / 8);
  for (std::size_t l = 0; l < light_count; ++l) mask[l / 8] |= static_cast<std::uint8_t>(1u << (l % 8));
  return mask;
}

struct FoundPoints {
  std::vector<MovedPoint> points;
  std::vector<std::uint8_t> masks;  // of the lights to be asked
};

// Which lights to ask about the points from number `begin` on, which the batch has just added to `found`.
void add_masks(ShadeBatch& batch, std::size_t begin, const std::vector<simd::LightSource>& lights,
               const std::vector<std::uint8_t>& all, bool asks_all, FoundPoints& found) {
  const std::size_t stride = all.size();
  found.masks.resize(found.points.size() * stride);
  if (!asks_all) return batch.find_lights_of_moved(lights, found.masks.data() + begin * stride, stride);
  for (std::size_t k = begin; k < found.points.size(); ++k) {
    std::copy(all.begin(), all.end(), found.masks.data() + k * stride);
  }
}

// Shares the lights between the true points, which those before the face are asked about, and the moved ones; drops
// moved points from number `begin` on that no light is left for.
void share_lights(std::size_t begin, SeenPoints& seen, FoundPoints& found) {
  const std::size_t stride = seen.stride;
  std::size_t kept = begin;
  for (std::size_t k = begin; k < found.points.size(); ++k) {
    std::uint8_t* facing = seen.masks.data() + found.points[k].owner * stride;
    bool any = false;
    for (std::size_t byte = 0; byte < stride; ++byte) {
      const std::uint8_t wanted = found.masks[k * stride + byte];
      const auto behind = static_cast<std::uint8_t>(wanted & ~facing[byte]);
      facing[byte] = static_cast<std::uint8_t>(wanted & facing[byte]);
      found.masks[kept * stride + byte] = behind;
      any = any || behind != 0;
    }
    if (any) found.points[kept++] = found.points[k];
  }
  found.points.resize(kept);
  found.masks.resize(kept * stride);
}

// The moved points of all chunks, one after the other, with places behind the seen ones; `found` is used up.
MovedPoints join(std::vector<FoundPoints>& found, const Executor& executor, SeenPoints& seen) {
  std::vector<std::size_t> starts(found.size() + 1);
  for (std::size_t chunk = 0; chunk < found.size(); ++chunk) {
    starts[chunk + 1] = starts[chunk] + found[chunk].points.size();
  }
  MovedPoints moved;
  moved.owners.resize(starts.back());
  moved.positions.resize(starts.back());
  std::vector<std::uint8_t> masks(starts.back() * seen.stride);
  executor.for_each(found.size(), [&](std::size_t chunk, int) {
    std::size_t i = starts[chunk];
    std::copy(found[chunk].masks.begin(), found[chunk].masks.end(), masks.data() + i * seen.stride);
    for (const MovedPoint& point : found[chunk].points) {
      moved.owners[i] = point.owner;
      moved.positions[i++] = point.position;
    }
    found[chunk] = {};
  });
  const std::size_t seen_bytes = seen.masks.size();
  add_places(moved, seen);
  std::copy(masks.begin(), masks.end(), seen.masks.data() + seen_bytes);
  return moved;
}

}  // namespace

MovedPoints find_moved_points(const Scene& scene, const SampleGrid& grid, SeenPoints& seen,
                              const std::vector<Light>& lights, const Renderer::Options& options,
                              const Executor& executor) {
  if (options.normals == Renderer::Normals::Flat || !options.shadow_terminator_fix) return {};

  const std::vector<simd::LightSource> sources = light_sources(lights, options.falloff);
  const std::vector<std::uint8_t> all = full_mask(lights.size());
  std::vector<FoundPoints> found(chunks_of(seen.points.size()));
  for_each_chunk(scene, grid, seen.points, true, nullptr, executor,
                 [&](ShadeBatch& batch, std::size_t first, std::size_t end, std::size_t chunk) {
                   while (first < end) {
                     first = batch.take_smooth(seen.points, first, end);
                     const std::size_t begin = found[chunk].points.size();
                     batch.find_moved(found[chunk].points);
                     add_masks(batch, begin, sources, all, options.planes.has(Plane::Lights), found[chunk]);
                     share_lights(begin, seen, found[chunk]);
                   }
                 });
  return join(found, executor, seen);
}

void clear_unreached(const Scene& scene, const SampleGrid& grid, SeenPoints& seen, const std::vector<Light>& lights,
                     const Executor& executor) {
  const std::vector<simd::LightSource> sources = light_sources(lights, Renderer::Falloff::Constant);
  if (std::none_of(sources.begin(), sources.end(), is_windowed)) return;
  for_each_chunk(scene, grid, seen.points, false, nullptr, executor,
                 [&](ShadeBatch& batch, std::size_t first, std::size_t end, std::size_t) {
                   for (std::size_t count = 0; first < end; first += count) {
                     count = batch.take(seen.points, first, end);
                     batch.clear_unreached(sources, seen.masks.data() + first * seen.stride, seen.stride);
                   }
                 });
}

namespace {

// Calls store(batch, first) for all batches, shaded; `first`: the number of their first point.
template <class Store>
void shade_all(const Scene& scene, const SampleGrid& grid, const SeenPoints& seen, const std::vector<Light>& lights,
               const Renderer::Options& options, const Executor& executor, const MaterialTable* materials,
               const Store& store) {
  const std::vector<simd::LightSource> sources = light_sources(lights, options.falloff);
  const Surroundings surroundings(options);
  for_each_chunk(scene, grid, seen.points, options.normals == Renderer::Normals::Smooth, materials, executor,
                 [&](ShadeBatch& batch, std::size_t first, std::size_t end, std::size_t) {
                   for (std::size_t count = 0; first < end; first += count) {
                     count = batch.take(seen.points, first, end);
                     batch.shade(sources, surroundings, seen.masks.data() + first * seen.stride, seen.stride);
                     store(batch, first);
                   }
                 });
}

}  // namespace

void shade_points(const Scene& scene, const SampleGrid& grid, const SeenPoints& seen, const std::vector<Light>& lights,
                  const Renderer::Options& options, const Executor& executor, std::span<Color> colors,
                  const MaterialTable* materials) {
  shade_all(scene, grid, seen, lights, options, executor, materials,
            [&](ShadeBatch& batch, std::size_t) { batch.store_colors(colors); });
}

PointLooks look_at_points(const Scene& scene, const SampleGrid& grid, const SeenPoints& seen,
                          const std::vector<Light>& lights, const Renderer::Options& options, const Executor& executor,
                          const MaterialTable* materials) {
  PointLooks looks{std::vector<Color>(seen.points.size()), seen.masks};
  const std::vector<simd::LightSource> sources = light_sources(lights, options.falloff);
  shade_all(scene, grid, seen, lights, options, executor, materials, [&](ShadeBatch& batch, std::size_t first) {
    batch.store_in_order(looks.colors.data() + first);
    batch.keep_lights_before(sources, looks.masks.data() + first * seen.stride, seen.stride);
  });
  return looks;
}

}  // namespace facemap
