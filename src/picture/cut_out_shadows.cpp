#include "picture/cut_out_shadows.h"

#include <facemap/point_light.h>

#include <algorithm>

#include "map/light_lists.h"
#include "map/map_faces.h"
#include "picture/lit_points.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

/// A map of faces with holes alone.
class CutOutLight : public PointLight {
 public:
  CutOutLight(const MapFaces& faces, const Vector& position) : PointLight(faces, position, Options()) {}
};

}  // namespace

void clear_blocked_by_cut_outs(const Scene& scene, const std::shared_ptr<const CutOuts>& cut_outs,
                               const LightPlaces& lights, const SampleGrid& grid, const Executor& executor,
                               const MovedPoints& moved, SeenPoints& seen, Counters& counters) {
  const FloatingPointMode mode;
  std::vector<std::size_t> asked;
  for (std::size_t l = 0; l < lights.size(); ++l) {
    if (lights.is_parallel[l] == 0) asked.push_back(l);
  }
  const auto together = static_cast<std::size_t>(executor.threads());
  for (std::size_t first = 0; first < asked.size(); first += together) {
    ListsOfLights lists(std::min(together, asked.size() - first));
    executor.for_each(lists.size(), [&](std::size_t i, int) {
      const Vector& position = lights.at[asked[first + i]];
      lists[i] = std::make_unique<LightLists>(CutOutLight(MapFaces{scene, cut_outs, true}, position));
    });
    std::vector<const LightLists*> of_lights(lights.size());
    for (std::size_t i = 0; i < lists.size(); ++i) of_lights[asked[first + i]] = lists[i].get();
    clear_blocked_by_lists(of_lights, scene, grid, executor, moved, seen, counters);
  }
}

}  // namespace facemap
