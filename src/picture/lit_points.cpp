#include "picture/lit_points.h"

#include <facemap/point_light.h>

#include <mutex>
#include <span>

#include "map/face_planes.h"
#include "math/exact_sign.h"

namespace facemap {
namespace {

constexpr std::size_t kFewestPoints = 4096;  // a task of asking lists

TruePoint true_point(const Scene& scene, const SampleGrid& grid, std::uint32_t sample, std::uint32_t face) {
  const auto columns = static_cast<std::uint32_t>(grid.columns());
  const Triangle triangle = triangle_of(scene, face);
  const Vector& K = grid.frame.position();
  return {K, grid.direction(static_cast<int>(sample % columns), static_cast<int>(sample / columns)), triangle,
          side(triangle, K)};
}

/// One light's part of the work: bits in memory of its own, so that lights can run at the same time.
class LightTask {
 public:
  LightTask(const Scene& scene, const SampleGrid& grid, const SeenPoints& seen, const Vector& light, std::size_t index)
      : scene_(scene), grid_(grid), seen_(seen), light_(light), byte_(index / 8), bit_(1u << (index % 8)) {}

  /// 0 or 1 a point: 1 if it faces the light.
  std::vector<std::uint8_t> facing() const {
    std::vector<std::uint8_t> faces_light(seen_.points.size());
    const std::uint8_t* mask = seen_.masks.data() + byte_;
    for (std::size_t i = 0; i < faces_light.size(); ++i) faces_light[i] = (mask[i * seen_.stride] & bit_) != 0;
    return faces_light;
  }

  /// Clears `lit` where the light is blocked.
  void ask(std::vector<std::uint8_t>& lit, const ClosedParts* closed, ShadowScratch& scratch,
           Counters& counters) const {
    std::vector<std::uint8_t> skippable;
    if (closed != nullptr) skippable = closed->skippable_entries(scene_, grid_.frame.position(), light_);
    clear_blocked(
        scene_, light_, seen_.points, {lit.data(), 1, 0}, skippable.empty() ? nullptr : skippable.data(),
        [this](std::size_t point, std::uint32_t face, int side) { return blocks_point(point, face, side); }, scratch,
        &counters);
    if (!skippable.empty()) ask_loose(lit, scratch, counters);
  }

  /// The same for seen.dull, of which `faces` are the own faces.
  std::vector<std::uint8_t> ask_dull(const std::vector<FaceId>& faces, Counters& counters) const {
    std::vector<std::uint8_t> lit(seen_.dull.size());
    if (lit.empty()) return lit;
    const PointLight map(scene_, light_);
    for (std::size_t i = 0; i < lit.size(); ++i) {
      const TruePoint p = true_point(seen_.dull[i], static_cast<std::uint32_t>(faces[i]));
      lit[i] = map.get_lighten_up({p.K, p.d, p.face, faces[i], p.s}, &counters);
    }
    return lit;
  }

 private:
  TruePoint true_point(std::uint32_t sample, std::uint32_t face) const {
    return facemap::true_point(scene_, grid_, sample, face);
  }

  bool blocks_point(std::size_t point, std::uint32_t face, int face_side) const {
    return blocks(triangle_of(scene_, face), face_side, light_,
                  true_point(seen_.points.samples[point], seen_.points.faces[point]));
  }

  // Exit faces speak for a closed part only at points strictly inside their face: the others ask all faces.
  void ask_loose(std::vector<std::uint8_t>& lit, ShadowScratch& scratch, Counters& counters) const {
    AskedPoints loose;
    loose.origin = seen_.points.origin;
    loose.step = seen_.points.step;
    loose.error = seen_.points.error;
    std::vector<std::uint32_t> numbers;
    for (const std::uint32_t i : seen_.loose) {
      if (lit[i] == 0) continue;
      numbers.push_back(i);
      loose.x.push_back(seen_.points.x[i]);
      loose.y.push_back(seen_.points.y[i]);
      loose.z.push_back(seen_.points.z[i]);
      loose.faces.push_back(seen_.points.faces[i]);
      loose.samples.push_back(seen_.points.samples[i]);
    }
    if (numbers.empty()) return;
    std::vector<std::uint8_t> still_lit(numbers.size(), 1);
    clear_blocked(
        scene_, light_, loose, {still_lit.data(), 1, 0}, nullptr,
        [&](std::size_t point, std::uint32_t face, int face_side) {
          return blocks_point(numbers[point], face, face_side);
        },
        scratch, &counters);
    for (std::size_t k = 0; k < numbers.size(); ++k) lit[numbers[k]] = still_lit[k];
  }

  const Scene& scene_;
  const SampleGrid& grid_;
  const SeenPoints& seen_;
  Vector light_;
  std::size_t byte_;
  unsigned bit_;
};

void set_bits(std::vector<std::uint8_t>& masks, std::size_t stride, std::size_t light,
              const std::vector<std::uint8_t>& lit) {
  const auto bit = static_cast<std::uint8_t>(1u << (light % 8));
  std::uint8_t* mask = masks.data() + light / 8;
  for (std::size_t i = 0; i < lit.size(); ++i) {
    std::uint8_t& m = mask[i * stride];
    m = static_cast<std::uint8_t>((m & ~bit) | (lit[i] != 0 ? bit : 0u));
  }
}

}  // namespace

LitPoints find_lit_points(const Scene& scene, const SampleGrid& grid, const NearestFaces& nearest, SeenPoints seen,
                          const std::vector<Vector>& lights, const ClosedParts* closed, const Executor& executor,
                          std::vector<ShadowScratch>& scratch, Counters* counters) {
  LitPoints result;
  result.dull_masks.resize(seen.dull.size() * seen.stride);
  std::vector<FaceId> dull_faces;
  for (const std::uint32_t sample : seen.dull) dull_faces.push_back(nearest.faces[sample]);

  std::mutex merging;
  std::vector<std::uint8_t>& masks = seen.masks;
  const SeenPoints& asked = seen;
  executor.for_each(lights.size(), [&](std::size_t l, int worker) {
    Counters own;
    const LightTask task(scene, grid, asked, lights[l], l);
    std::vector<std::uint8_t> lit;
    {
      const std::scoped_lock lock(merging);  // other lights write their bits into the same bytes
      lit = task.facing();
    }
    task.ask(lit, closed, scratch[static_cast<std::size_t>(worker)], own);
    const std::vector<std::uint8_t> dull_lit = task.ask_dull(dull_faces, own);
    const std::scoped_lock lock(merging);
    set_bits(masks, asked.stride, l, lit);
    set_bits(result.dull_masks, asked.stride, l, dull_lit);
    if (counters != nullptr) *counters += own;
  });
  result.seen = std::move(seen);
  return result;
}

LitPoints find_lit_points(const Scene& scene, const SampleGrid& grid, const NearestFaces& nearest, SeenPoints seen,
                          const std::vector<PointLight>& lists, const Executor& executor, Counters* counters) {
  LitPoints result;
  result.seen = std::move(seen);
  const AskedPoints& points = result.seen.points;
  const std::size_t stride = result.seen.stride;
  std::mutex merging;
  const auto ask = [&](std::uint32_t sample, std::uint32_t face, std::uint8_t* mask, bool faces_lights, Counters& own) {
    const TruePoint p = true_point(scene, grid, sample, face);
    const SurfacePoint point{p.K, p.d, p.face, static_cast<FaceId>(face), p.s};
    for (std::size_t l = 0; l < lists.size(); ++l) {
      const auto bit = static_cast<std::uint8_t>(1u << (l % 8));
      if (faces_lights && (mask[l / 8] & bit) == 0) continue;
      const bool lit = faces_lights ? !lists[l].is_blocked(point, &own) : lists[l].get_lighten_up(point, &own);
      mask[l / 8] = static_cast<std::uint8_t>((mask[l / 8] & ~bit) | (lit ? bit : 0u));
    }
  };
  for_ranges(executor, points.size(), kFewestPoints, [&](std::size_t first, std::size_t last, int) {
    Counters own;
    for (std::size_t i = first; i < last; ++i) {
      ask(points.samples[i], points.faces[i], &result.seen.masks[i * stride], true, own);
    }
    const std::scoped_lock lock(merging);
    if (counters != nullptr) *counters += own;
  });
  result.dull_masks.resize(result.seen.dull.size() * stride);
  Counters own;
  for (std::size_t i = 0; i < result.seen.dull.size(); ++i) {
    const std::uint32_t sample = result.seen.dull[i];
    ask(sample, static_cast<std::uint32_t>(nearest.faces[sample]), &result.dull_masks[i * stride], false, own);
  }
  if (counters != nullptr) *counters += own;
  return result;
}

void clear_blocked_positions(const Scene& scene, const AskedPoints& points, const std::vector<Vector>& positions,
                             const std::vector<Vector>& lights, std::vector<std::uint8_t>& masks, std::size_t stride,
                             const Executor& executor, std::vector<ShadowScratch>& scratch, Counters* counters) {
  if (positions.empty()) return;
  std::mutex merging;
  executor.for_each(lights.size(), [&](std::size_t l, int worker) {
    Counters own;
    std::vector<std::uint8_t> lit(positions.size(), 1);
    const auto blocks_position = [&](std::size_t i, std::uint32_t face, int face_side) {
      return blocks(triangle_of(scene, face), face_side, lights[l], GivenPoint{positions[i]}, &own);
    };
    clear_blocked(scene, lights[l], points, {lit.data(), 1, 0}, nullptr, blocks_position,
                  scratch[static_cast<std::size_t>(worker)], &own);
    const std::scoped_lock lock(merging);
    set_bits(masks, stride, l, lit);
    if (counters != nullptr) *counters += own;
  });
}

void clear_blocked_positions(const std::vector<Vector>& positions, const std::vector<PointLight>& lists,
                             std::vector<std::uint8_t>& masks, std::size_t stride, const Executor& executor,
                             Counters* counters) {
  std::mutex merging;
  for_ranges(executor, positions.size(), kFewestPoints, [&](std::size_t first, std::size_t last, int) {
    Counters own;
    for (std::size_t i = first; i < last; ++i) {
      for (std::size_t l = 0; l < lists.size(); ++l) {
        std::uint8_t& mask = masks[i * stride + l / 8];
        if (!lists[l].get_lighten_up(positions[i], &own)) mask = static_cast<std::uint8_t>(mask & ~(1u << (l % 8)));
      }
    }
    const std::scoped_lock lock(merging);
    if (counters != nullptr) *counters += own;
  });
}

}  // namespace facemap
