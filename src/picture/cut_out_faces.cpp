#include "picture/cut_out_faces.h"

#include <facemap/camera.h>

#include <mutex>
#include <vector>

#include "map/face_planes.h"
#include "map/map_faces.h"
#include "map/nearest_hit.h"
#include "picture/wide_map.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

constexpr std::size_t kLeastSamples = 1 << 12;  // of a task

/// A map of faces with holes alone.
class CutOutCamera : public Camera {
 public:
  CutOutCamera(const MapFaces& faces, const SpaceVector& frame, const Options& options)
      : Camera(faces, frame, options) {}

  bool may_meet(const Texel& texel) const { return !cut_outs_at(texel.x, texel.y).empty(); }
  using Camera::meet_faces;
};

class Finder {
 public:
  Finder(const Scene& scene, const CutOutCamera& camera, const SampleGrid& grid, NearestFaces& nearest,
         std::vector<std::uint8_t>& is_loose)
      : scene_(scene), camera_(camera), grid_(grid), nearest_(nearest), is_loose_(is_loose) {}

  void find(std::size_t sample, Counters& counters) {
    const auto columns = static_cast<std::size_t>(grid_.columns());
    const Vector d = grid_.direction(static_cast<int>(sample % columns), static_cast<int>(sample / columns));
    const auto texel = camera_.texel_of(DVector(d));
    if (!texel || !camera_.may_meet(*texel)) return;
    FaceId& face = nearest_.faces[sample];
    const FaceId solid = face;
    NearestHit best(scene_, camera_.position(), d, &counters);
    if (solid != kNoFace) {
      const auto id = static_cast<std::uint32_t>(solid);
      best.meet(id, side(triangle_of(scene_, id), camera_.position(), &counters), true);
    }
    camera_.meet_faces(*texel, d, best, &counters);
    const Camera::Hit& hit = best.hit();
    face = hit.face;
    // Of the solid face it is known whether it is loose among the solid ones.
    if (hit.face != solid) is_loose_[sample] = hit.tied || !hit.strictly_inside;
    if (hit.tied) is_loose_[sample] = 1;
  }

 private:
  const Scene& scene_;
  const CutOutCamera& camera_;
  const SampleGrid& grid_;
  NearestFaces& nearest_;
  std::vector<std::uint8_t>& is_loose_;
};

}  // namespace

void add_cut_outs(const Scene& scene, const std::shared_ptr<const CutOuts>& cut_outs, const SampleGrid& grid,
                  const Executor& executor, NearestFaces& nearest, Counters* counters) {
  const FloatingPointMode mode;
  const CutOutCamera camera({scene, cut_outs, true}, grid.frame, wide_map(grid.lens));
  std::vector<std::uint8_t> is_loose(nearest.faces.size());
  for (const std::uint32_t sample : nearest.loose) is_loose[sample] = 1;
  std::mutex merging;
  for_ranges(executor, nearest.faces.size(), kLeastSamples, [&](std::size_t first, std::size_t last, int) {
    Counters own;
    Finder finder(scene, camera, grid, nearest, is_loose);
    for (std::size_t sample = first; sample < last; ++sample) finder.find(sample, own);
    const std::scoped_lock lock(merging);
    if (counters != nullptr) *counters += own;
  });
  nearest.loose.clear();
  for (std::size_t i = 0; i < is_loose.size(); ++i) {
    if (is_loose[i] != 0) nearest.loose.push_back(static_cast<std::uint32_t>(i));
  }
}

}  // namespace facemap
