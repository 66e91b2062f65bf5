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
                               const MovedPoints& moved, KeptCutOutLists* kept, SeenPoints& seen, Counters& counters) {
  const FloatingPointMode mode;
  std::vector<const LightLists*> of_lights(lights.size());
  std::vector<std::size_t> missing;
  if (kept != nullptr) kept->of_lights.resize(lights.size());
  for (std::size_t l = 0; l < lights.size(); ++l) {
    if (kept != nullptr) of_lights[l] = kept->of_lights[l].get();
    if (of_lights[l] == nullptr && lights.is_parallel[l] == 0) missing.push_back(l);
  }
  if (missing.size() < lights.size()) clear_blocked_by_lists(of_lights, scene, grid, executor, moved, seen, counters);

  const auto together = static_cast<std::size_t>(executor.threads());
  for (std::size_t first = 0; first < missing.size(); first += together) {
    ListsOfLights lists(std::min(together, missing.size() - first));
    executor.for_each(lists.size(), [&](std::size_t i, int) {
      const Vector& position = lights.at[missing[first + i]];
      lists[i] = std::make_unique<LightLists>(CutOutLight(MapFaces{scene, cut_outs, true}, position));
    });
    std::fill(of_lights.begin(), of_lights.end(), nullptr);
    for (std::size_t i = 0; i < lists.size(); ++i) of_lights[missing[first + i]] = lists[i].get();
    clear_blocked_by_lists(of_lights, scene, grid, executor, moved, seen, counters);
    for (std::size_t i = 0; kept != nullptr && i < lists.size(); ++i) {
      const std::size_t bytes = lists[i]->memory_bytes();
      if (kept->bytes + bytes > KeptCutOutLists::kMostBytes) break;
      kept->bytes += bytes;
      kept->of_lights[missing[first + i]] = std::move(lists[i]);
    }
  }
}

}  // namespace facemap
