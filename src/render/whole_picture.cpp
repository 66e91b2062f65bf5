#include "render/whole_picture.h"

#include <bit>

#include "picture/lit_points.h"
#include "picture/nearest_faces.h"
#include "picture/sample_grid.h"
#include "picture/seen_points.h"
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
std::vector<std::uint8_t> masks_by_sample(const LitPoints& lit, std::size_t samples) {
  const std::size_t stride = lit.seen.stride;
  std::vector<std::uint8_t> masks(samples * stride);
  const auto put = [&](std::uint32_t sample, const std::uint8_t* mask) {
    for (std::size_t k = 0; k < stride; ++k) masks[sample * stride + k] = mask[k];
  };
  const std::vector<std::uint32_t>& seen = lit.seen.points.samples;
  for (std::size_t i = 0; i < seen.size(); ++i) put(seen[i], &lit.seen.masks[i * stride]);
  for (std::size_t i = 0; i < lit.seen.dull.size(); ++i) put(lit.seen.dull[i], &lit.dull_masks[i * stride]);
  return masks;
}

}  // namespace

struct WholePicture::Planes {
  SampleGrid grid;
  std::vector<FaceId> ids;
  std::vector<std::uint8_t> lights;
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

WholePicture::Planes WholePicture::find_planes(int per_side) {
  const SampleGrid grid{SpaceVector::looking_at(view_.position, view_.look_at, view_.up),
                        Projection(view_.projection, view_.field_angle, options_.width, options_.height), per_side};
  const std::vector<Vector> lights = positions_of(lights_);

  const Stopwatch camera_time;
  report_(0, "camera map");
  NearestFaces nearest = find_nearest_faces(scene_, grid, executor_, &statistics_.camera_tests);
  statistics_.camera_queries += grid.count();
  SeenPoints seen = find_seen_points(scene_, grid, nearest, lights, executor_);
  statistics_.camera_map_ms += camera_time.milliseconds();

  const Stopwatch closed_time;
  report_(0, "light maps");
  if (lists_ == nullptr && !state_.closed) state_.closed = std::make_unique<ClosedParts>(scene_, executor_);
  statistics_.light_maps_ms += closed_time.milliseconds();

  const Stopwatch light_time;
  report_(0, "shade");
  for (const std::uint8_t mask : seen.masks) statistics_.light_queries += static_cast<unsigned>(std::popcount(mask));
  const LitPoints lit =
      lists_ != nullptr
          ? find_lit_points(scene_, grid, nearest, std::move(seen), *lists_, executor_, &statistics_.light_tests)
          : find_lit_points(scene_, grid, nearest, std::move(seen), lights, state_.closed.get(), executor_,
                            state_.scratch, &statistics_.light_tests);
  Planes planes{grid, std::move(nearest.faces), masks_by_sample(lit, grid.count())};
  statistics_.shade_ms += light_time.milliseconds();
  return planes;
}

Image WholePicture::look() {
  Planes planes = find_planes(options_.samples);
  Image image;
  image.width = planes.grid.columns();
  image.height = planes.grid.rows();
  image.light_count = static_cast<int>(lights_.size());
  image.ids = std::move(planes.ids);
  image.lights = std::move(planes.lights);
  return image;
}

}  // namespace facemap
