#include "picture/lit_points.h"

#include <mutex>
#include <optional>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "picture/face_pairs.h"

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

// Calls task(light, mask, worker, counters) for each light, which clears its bits.
template <class Task>
void for_each_light(const LightWork& work, std::size_t stride, std::vector<std::uint8_t>& masks, Counters& counters,
                    const Task& task) {
  const std::vector<std::uint8_t> asked = masks;
  const bool has_bounds = work.bounds != nullptr && work.bounds->are_made();
  const std::size_t most = has_bounds ? 0 : most_asked(asked, stride);
  std::mutex writing, reporting;
  std::size_t done = 0;
  work.executor.for_each(work.lights.size(), [&](std::size_t l, int worker) {
    Counters own;
    const MaskBit mask{asked.data(), masks.data(), stride, static_cast<int>(l), &writing, most};
    task(l, mask, worker, own);
    const std::scoped_lock lock(reporting);
    counters += own;
    work.report(static_cast<double>(++done) / static_cast<double>(work.lights.size()));
  });
}

// Those of `points` whose bit is set.
std::vector<std::uint32_t> still_lit(const std::vector<std::uint32_t>& points, const MaskBit& mask) {
  const std::unique_lock lock = mask.hold();
  std::vector<std::uint32_t> lit;
  for (const std::uint32_t i : points) {
    if (mask.is_lit(i)) lit.push_back(i);
  }
  return lit;
}

AskedPoints subset(const AskedPoints& points, const std::vector<std::uint32_t>& numbers) {
  AskedPoints some;
  copy_points(points, numbers, 0, some);
  return some;
}

}  // namespace

void clear_blocked(const LightWork& work, const SampleGrid& grid, const MovedPoints& moved, SeenPoints& seen,
                   Counters& counters) {
  const Scene& scene = work.scene;
  const AskedPoints& points = seen.points;
  if (points.size() == 0) return;
  std::vector<std::uint8_t> outside_camera;
  if (work.closed != nullptr) outside_camera = work.closed->outside(scene, grid.frame.position());
  const bool is_for_lists = work.bounds != nullptr && work.bounds->are_made() &&
                            are_lists_quicker(most_asked(seen.masks, seen.stride), scene.kept_faces().size());

  for_each_light(
      work, seen.stride, seen.masks, counters, [&](std::size_t l, const MaskBit& mask, int worker, Counters& own) {
        if (work.lights.is_parallel[l] != 0) return;
        const Vector& light = work.lights.at[l];
        ShadowScratch& scratch = work.scratch[static_cast<std::size_t>(worker)];
        FacePairs pairs(scene);
        const BlocksExactly is_between = [&](std::size_t point, std::uint32_t face, int face_side) {
          if (points.faces[point] == kNoOwnFace) {
            const GivenPoint given{moved.position_of(static_cast<std::uint32_t>(point))};
            return blocks(triangle_of(scene, face), face_side, light, given, &own);
          }
          if (pairs.is_clear(points.faces[point], face, face_side, own)) return false;
          return blocks(triangle_of(scene, face), face_side, light,
                        true_point(scene, grid, points.samples[point], points.faces[point]), &own);
        };
        // Some of the points, which are still lit.
        const auto ask_some = [&](const AskedPoints& some, const std::uint32_t* numbers,
                                  const std::uint8_t* skip_entries, const std::vector<std::uint32_t>* some_faces) {
          std::vector<std::uint8_t> lit(some.size(), 1);
          clear_blocked(
              scene, light, some, {lit.data(), lit.data(), 1, 0}, skip_entries,
              [&](std::size_t point, std::uint32_t face, int face_side) {
                return is_between(numbers[point], face, face_side);
              },
              scratch, &own, some_faces);
          const std::unique_lock lock = mask.hold();
          for (std::size_t k = 0; k < lit.size(); ++k) {
            if (lit[k] == 0) mask.clear(numbers[k]);
          }
        };

        std::vector<std::uint8_t> skippable;
        if (work.closed != nullptr) skippable = work.closed->skippable_entries(scene, outside_camera, light);
        const std::uint8_t* skip_entries = skippable.empty() ? nullptr : skippable.data();
        const LightBounds* bounds = work.bounds != nullptr ? work.bounds->of(l, outside_camera) : nullptr;
        if (bounds != nullptr) {
          DecidedPoints& decided = work.bounds->work(worker);
          const bool asks_lists = is_for_lists && can_ask_lists(scene, light, size_of_offsets(points, light));
          const DecidedCount count = decide_points(*bounds, light, points, mask, decided, own, asks_lists);
          std::size_t held = 0;
          if (!decided.listed.numbers.empty()) {
            held =
                ask_lists(scene, light, *bounds->lists(), points, mask, is_between, decided.listed, decided.dark, own);
          }
          ask_some(decided.open, decided.numbers.data(), skip_entries, decided.faces);
          const bool has_lists = asks_lists && bounds->lists() != nullptr;
          if (!KeptBounds::are_worth_keeping(count, has_lists, held)) work.bounds->drop(l);
        } else {
          clear_blocked(scene, light, points, mask, skip_entries, is_between, scratch, &own);
        }
        if (skip_entries == nullptr) return;
        // Exit faces speak for a closed part only at points strictly inside their face: the others ask all
        // faces.
        const std::vector<std::uint32_t> numbers = still_lit(seen.loose, mask);
        if (!numbers.empty()) ask_some(subset(points, numbers), numbers.data(), nullptr, nullptr);
      });
  if (work.bounds != nullptr) work.bounds->tidy();
}

namespace {

// A point that asks the lists of one light after the other.
class ListedPoint {
 public:
  ListedPoint(const Scene& scene, const SampleGrid& grid, const MovedPoints& moved, const AskedPoints& points,
              std::uint32_t number)
      : scene_(scene), grid_(grid), moved_(moved), points_(points), number_(number) {}

  // First about where the point is held to be, which is quick; then, where that is open, about the point itself.
  bool is_blocked(const LightLists& light, Counters& counters) {
    const bool is_moved = points_.faces[number_] == kNoOwnFace;
    const FaceId face = is_moved ? kNoFace : static_cast<FaceId>(points_.faces[number_]);
    const auto known = light.is_blocked_around(place_of(points_, number_), error_of(points_, number_), face, &counters);
    if (known) return *known;
    return is_moved ? !light.is_lit(moved_.position_of(number_), &counters)
                    : light.is_blocked(surface_point(), &counters);
  }

 private:
  const SurfacePoint& surface_point() {
    if (!surface_point_) {
      const std::uint32_t face = points_.faces[number_];
      const TruePoint p = true_point(scene_, grid_, points_.samples[number_], face);
      surface_point_ = {p.K, p.d, p.face, static_cast<FaceId>(face), p.s};
    }
    return *surface_point_;
  }

  const Scene& scene_;
  const SampleGrid& grid_;
  const MovedPoints& moved_;
  const AskedPoints& points_;
  std::uint32_t number_;
  std::optional<SurfacePoint> surface_point_;  // once it is needed
};

}  // namespace

void clear_blocked_by_lists(const std::vector<const LightLists*>& lists, const Scene& scene, const SampleGrid& grid,
                            const Executor& executor, const MovedPoints& moved, SeenPoints& seen, Counters& counters) {
  std::mutex merging;
  for_ranges(executor, seen.points.size(), kFewestPoints, [&](std::size_t first, std::size_t last, int) {
    Counters own;
    for (std::size_t i = first; i < last; ++i) {
      ListedPoint point(scene, grid, moved, seen.points, static_cast<std::uint32_t>(i));
      for (std::size_t l = 0; l < lists.size(); ++l) {
        std::uint8_t& mask = seen.masks[i * seen.stride + l / 8];
        const auto bit = static_cast<std::uint8_t>(1u << (l % 8));
        if (lists[l] == nullptr || (mask & bit) == 0) continue;
        if (point.is_blocked(*lists[l], own)) mask = static_cast<std::uint8_t>(mask & ~bit);
      }
    }
    const std::scoped_lock lock(merging);
    counters += own;
  });
}

}  // namespace facemap
