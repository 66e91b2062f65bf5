#include "facemap_bench_confirm.h"

#include <facemap/camera.h>
#include <facemap/point_light.h>

#include <algorithm>

namespace facemap::bench {

std::size_t confirm(const Case& question, const View& view, const Options& options, const Image& ours,
                    const std::vector<std::size_t>& where) {
  Camera::Options camera_options;
  camera_options.projection = view.projection;
  camera_options.field_angle = view.field_angle;
  camera_options.width = camera_options.height = options.size;
  const Camera camera(question.scene, SpaceVector::looking_at(view.position, view.look_at, view.up), camera_options);
  std::vector<bool> agrees(where.size(), true);
  const auto direction = [&](std::size_t sample) {
    const auto centre = [&](std::size_t i) {
      const auto n = static_cast<std::size_t>(options.samples);
      return double(i / n) + (double(i % n) + 0.5) / options.samples;
    };
    const auto columns = static_cast<std::size_t>(ours.width);
    return camera.direction_through({centre(sample % columns), centre(sample / columns)});
  };

  for (std::size_t i = 0; i < where.size(); ++i) {
    agrees[i] = camera.nearest(direction(where[i])).face == ours.ids[where[i]];
  }
  for (std::size_t l = 0; l < question.lights.size(); ++l) {
    const PointLight light(question.scene, question.lights[l].position);
    for (std::size_t i = 0; i < where.size(); ++i) {
      if (!agrees[i]) continue;
      const Camera::Hit hit = camera.nearest(direction(where[i]));
      const bool lit = hit && light.get_lighten_up(camera.surface_point(direction(where[i]), hit));
      const std::uint8_t mask = ours.lights[where[i] * std::size_t(ours.light_bytes()) + l / 8];
      agrees[i] = lit == (((mask >> l % 8) & 1) != 0);
    }
  }
  return std::size_t(std::count(agrees.begin(), agrees.end(), true));
}

}  // namespace facemap::bench
