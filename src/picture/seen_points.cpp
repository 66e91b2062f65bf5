#include "picture/seen_points.h"

#include <algorithm>
#include <cstring>
#include <memory>

#include "math/dvector.h"
#include "picture/facing_masks.h"
#include "picture/point_box.h"
#include "picture/ray_table.h"
#include "picture/tile_batch.h"

namespace facemap {
namespace {

// The box of a larger picture's points is guessed from few of them. Coordinates of the guessed box take 29 bits, which
// leaves as much room again on every side before round_offsets refuses a point; then all are looked at.
constexpr std::size_t kSmallPicture = 65536;  // samples
constexpr double kStepsOfBox = 0x1p29;

// Where doubles leave a ray's point open by more than this share of a step it is computed exactly.
constexpr double kSharpShare = 0.125;

// The same for the guess, in units of the scene's size and the camera's distance.
constexpr double kGuessShare = 0x1p-20;

// Working memory of one thread.
struct Work {
  TileBatch batch;
  FacingMasks facing;
  std::int32_t coordinates[3][simd::kSeenBatch];
};

class PointFinder {
 public:
  PointFinder(const Scene& scene, const SampleGrid& grid, const NearestFaces& nearest, const LightPlaces& lights,
              const Executor& executor)
      : scene_(scene), grid_(grid), nearest_(nearest), executor_(executor), rays_(grid), memory_(nearest.spare) {
    const Vector& camera = grid.frame.position();
    for (int i = 0; i < executor.threads(); ++i) {
      work_.push_back(std::unique_ptr<Work>(
          new Work{TileBatch(scene, grid, nearest, rays_), FacingMasks(scene, camera, lights), {}}));
    }
    farthest_ = length(DVector(camera) - scene.centre()) + scene.bounding_radius();
    seen_.stride = work_[0]->facing.stride();
  }

  SeenPoints find() {
    count_points();
    if (starts_.back() == 0) return std::move(seen_);
    const bool is_small = nearest_.faces.size() <= kSmallPicture;
    place_box(!is_small);
    if (!fill() && !is_small) {
      place_box(false);
      fill();
    }
    return std::move(seen_);
  }

 private:
  // Rows of tiles, the tasks of all passes.
  std::size_t bands() const { return (rays_.rows.size() + TileBatch::kTile - 1) / TileBatch::kTile; }
  std::size_t first_of_band(std::size_t band) const {
    return std::min(nearest_.faces.size(), band * TileBatch::kTile * rays_.columns.size());
  }

  // Where the points of each band begin.
  void count_points() {
    starts_.assign(bands() + 1, 0);
    executor_.for_each(bands(), [&](std::size_t band, int) {
      const FaceId* faces = nearest_.faces.data();
      std::size_t count = 0;
      for (std::size_t i = first_of_band(band); i < first_of_band(band + 1); ++i) count += faces[i] != kNoFace;
      starts_[band + 1] = count;
    });
    for (std::size_t band = 0; band < bands(); ++band) starts_[band + 1] += starts_[band];
    AskedPoints& points = seen_.points;
    place_array(4, points.x);
    place_array(3, points.y);
    place_array(2, points.z);
    place_array(1, points.faces);
    place_array(0, points.samples);
    if (nearest_.spare) nearest_.spare->give_back_rest();
    seen_.masks.resize(starts_.back() * seen_.stride);
  }

  // As long as there is spare memory there; else where the `after` arrays that follow have room too.
  template <class Value>
  void place_array(std::size_t after, UnsetVector<Value>& array) {
    const std::size_t bytes = SharedPages::room_for<Value>(starts_.back());
    if (!memory_ || !memory_->has_room(bytes)) memory_ = std::make_shared<SharedPages>((after + 1) * bytes);
    array = UnsetVector<Value>(starts_.back(), UnsetAllocator<Value>(memory_));
  }

  // ---- origin and step ----

  PointBox seen_box(const Vector& origin, double allowed, bool from_some) {
    std::vector<PointBox> boxes(bands());
    executor_.for_each(bands(), [&](std::size_t band, int worker) {
      TileBatch& batch = work_[static_cast<std::size_t>(worker)]->batch;
      const int row = static_cast<int>(band) * TileBatch::kTile;
      const int step = from_some ? TileBatch::kSparse : TileBatch::kTile;
      for (int column = 0; column < grid_.columns(); column += step) {
        if (from_some) {
          batch.collect_some(column, row);
        } else {
          batch.collect(column, row);
        }
        if (batch.size() == 0) continue;
        batch.find_offsets(origin, allowed);
        boxes[band].add(batch.box());
      }
    });
    PointBox all;
    for (const PointBox& box : boxes) all.add(box);
    return all;
  }

  void place_box(bool from_some) {
    const Vector centre(scene_.centre());
    const double allowed = kGuessShare * farthest_;
    PointBox box = seen_box(centre, allowed, from_some);
    if (box.is_empty()) box = {DVector(0), DVector(0)};  // none of the few samples saw a face
    origin_ = Vector(DVector(centre) + box.middle());
    const double half = box.reach_from(DVector(origin_) - DVector(centre)) + allowed;
    AskedPoints& points = seen_.points;
    points.origin = DVector(origin_);
    points.step = power_of_two_above(half) / kStepsOfBox;
    // Half a step for each coordinate (sqrt(3) / 2 < 0.8661), kSharpShare, and what meet_planes rounds: the base, the
    // product and the sum, each 2^-53 of a coordinate that is at most |K - O| + farthest.
    const double rounding = 0x1p-49 * (length(DVector(grid_.frame.position()) - points.origin) + farthest_);
    points.error = points.step * (0.8661 + kSharpShare) + rounding;
  }

  // ---- filling ----

  // False if some point does not fit the box.
  bool fill() {
    std::vector<std::uint8_t> fits(bands());
    std::vector<std::vector<std::uint32_t>> loose(bands());
    executor_.for_each(bands(), [&](std::size_t band, int worker) {
      fits[band] = fill_band(band, *work_[static_cast<std::size_t>(worker)], loose[band]);
    });
    seen_.loose.clear();
    for (const auto& numbers : loose) seen_.loose.insert(seen_.loose.end(), numbers.begin(), numbers.end());
    return std::find(fits.begin(), fits.end(), 0) == fits.end();
  }

  bool fill_band(std::size_t band, Work& work, std::vector<std::uint32_t>& loose) {
    const std::vector<std::uint8_t> is_loose = loose_samples(band);
    TileBatch& batch = work.batch;
    std::size_t first = starts_[band];
    for (int column = 0; column < grid_.columns(); column += TileBatch::kTile) {
      batch.collect(column, static_cast<int>(band) * TileBatch::kTile);
      if (batch.size() == 0) continue;
      batch.find_offsets(origin_, seen_.points.step * kSharpShare);
      if (!simd::round_offsets(batch.rays(), 1 / seen_.points.step, work.coordinates[0], work.coordinates[1],
                               work.coordinates[2])) {
        return false;
      }
      store_points(first, work);
      work.facing.store(batch.slots(), batch.rays().slots, batch.size(), seen_.masks.data() + first * seen_.stride);
      for (std::size_t i = 0; i < (is_loose.empty() ? 0 : batch.size()); ++i) {
        if (is_loose[batch.samples()[i] - first_of_band(band)]) loose.push_back(static_cast<std::uint32_t>(first + i));
      }
      first += batch.size();
    }
    return true;
  }

  // One flag for each sample of the band, or none if none is loose.
  std::vector<std::uint8_t> loose_samples(std::size_t band) const {
    const std::size_t begin = first_of_band(band), end = first_of_band(band + 1);
    auto next = std::lower_bound(nearest_.loose.begin(), nearest_.loose.end(), begin);
    if (next == nearest_.loose.end() || *next >= end) return {};
    std::vector<std::uint8_t> flags(end - begin);
    for (; next != nearest_.loose.end() && *next < end; ++next) flags[*next - begin] = 1;
    return flags;
  }

  void store_points(std::size_t first, const Work& work) {
    AskedPoints& points = seen_.points;
    const std::size_t bytes = work.batch.size() * sizeof(std::uint32_t);
    std::memcpy(points.x.data() + first, work.coordinates[0], bytes);
    std::memcpy(points.y.data() + first, work.coordinates[1], bytes);
    std::memcpy(points.z.data() + first, work.coordinates[2], bytes);
    std::memcpy(points.faces.data() + first, work.batch.faces(), bytes);
    std::memcpy(points.samples.data() + first, work.batch.samples(), bytes);
  }

  const Scene& scene_;
  const SampleGrid& grid_;
  const NearestFaces& nearest_;
  const Executor& executor_;
  const RayTable rays_;
  std::shared_ptr<SharedPages> memory_;  // where arrays of points go
  double farthest_ = 0;                  // the camera's distance from any seen point is at most this
  std::vector<std::unique_ptr<Work>> work_;
  std::vector<std::size_t> starts_;
  Vector origin_{0};
  SeenPoints seen_;
};

}  // namespace

SeenPoints find_seen_points(const Scene& scene, const SampleGrid& grid, const NearestFaces& nearest,
                            const LightPlaces& lights, const Executor& executor) {
  return PointFinder(scene, grid, nearest, lights, executor).find();
}

}  // namespace facemap
