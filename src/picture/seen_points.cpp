#include "picture/seen_points.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <memory>
#include <unordered_map>

#include "map/face_planes.h"
#include "math/dvector.h"
#include "math/exact_sign.h"
#include "picture/face_slots.h"
#include "picture/ray_table.h"
#include "simd/seen_planes.h"

namespace facemap {
namespace {

// Points stand tile by tile, in a tile block by block: neighbours in the picture stay neighbours in memory.
constexpr int kTile = 16;
constexpr int kBlockColumns = 8, kBlockRows = 2;
static_assert(kTile * kTile == simd::kSeenBatch);

// The box of the seen points is guessed from one sample in each cell of a larger picture. Coordinates of the guessed
// box take kBoxBits, which leaves as much room again on every side before round_offsets refuses a point.
constexpr int kCell = 8;
constexpr std::size_t kSmallPicture = 65536;
constexpr int kBoxBits = 29;

// Where doubles leave a ray's point open by more than this share of a step it is computed exactly.
constexpr double kSharpShare = 0.125;

// The same for the guess, in units of the scene's size and the camera's distance.
constexpr double kGuessShare = 0x1p-20;

struct Box {
  DVector lower{HUGE_VAL}, upper{-HUGE_VAL};

  void add(const Box& other) {
    for (int axis = 0; axis < 3; ++axis) {
      lower[axis] = std::min(lower[axis], other.lower[axis]);
      upper[axis] = std::max(upper[axis], other.upper[axis]);
    }
  }
};

// 2^k for the least k with x < 2^k; x positive and normal.
double power_of_two_above(double x) {
  return std::bit_cast<double>(((std::bit_cast<std::uint64_t>(x) >> 52) + 1) << 52);
}

std::uint64_t scrambled(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// Working memory of one thread.
struct Work {
  explicit Work(const Mesh& mesh) : slots(mesh) {}

  FaceSlots slots;
  simd::RayBatch rays;
  std::uint32_t samples[simd::kSeenBatch];
  std::uint32_t faces[simd::kSeenBatch];
  std::uint8_t is_sharp[simd::kSeenBatch];
  std::int32_t coordinates[3][simd::kSeenBatch];
  std::int32_t facing[simd::kSeenBatch], unsure[simd::kSeenBatch];
  std::unordered_map<std::uint64_t, int> sides;  // by face and light, where doubles left them open
};

class PointFinder {
 public:
  PointFinder(const Scene& scene, const SampleGrid& grid, const NearestFaces& nearest,
              const std::vector<Vector>& lights, const Executor& executor)
      : scene_(scene),
        grid_(grid),
        nearest_(nearest),
        lights_(lights),
        executor_(executor),
        rays_(grid),
        camera_(grid.frame.position()) {
    for (int i = 0; i < executor.threads(); ++i) work_.push_back(std::make_unique<Work>(scene.mesh()));
    farthest_ = length(DVector(camera_) - scene.centre()) + scene.bounding_radius();
  }

  SeenPoints find() {
    seen_.stride = (lights_.size() + 7) / 8;
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
  struct Tile {
    int column, row;
  };

  std::size_t columns() const { return rays_.columns.size(); }
  std::size_t bands() const { return (rays_.rows.size() + kTile - 1) / kTile; }
  std::size_t first_of_band(std::size_t band) const {
    return std::min(nearest_.faces.size(), band * kTile * columns());
  }

  // Where the points of each band of tiles begin.
  void count_points() {
    starts_.assign(bands() + 1, 0);
    executor_.for_each(bands(), [&](std::size_t band, int) {
      const FaceId* faces = nearest_.faces.data();
      std::size_t count = 0;
      for (std::size_t i = first_of_band(band); i < first_of_band(band + 1); ++i) count += faces[i] != kNoFace;
      starts_[band + 1] = count;
    });
    for (std::size_t band = 0; band < bands(); ++band) starts_[band + 1] += starts_[band];
    const std::size_t count = starts_.back();
    AskedPoints& points = seen_.points;
    points.x.resize(count);
    points.y.resize(count);
    points.z.resize(count);
    points.faces.resize(count);
    points.samples.resize(count);
    seen_.masks.resize(count * seen_.stride);
  }

  // ---- batches ----

  // Those of the samples begin..end-1 of a row that see a face.
  void add_run(int row, int begin, int end, Work& work) const {
    const auto first = static_cast<std::size_t>(row) * columns() + static_cast<std::size_t>(begin);
    const FaceId* faces = nearest_.faces.data() + first;
    const int length = end - begin;
    FaceId all = kNoFace;  // -1, and stays so only as long as no id is a face
    for (int i = 0; i < length; ++i) all &= faces[i];
    if (all == kNoFace) return;

    const double* x = rays_.columns.data() + begin;
    const double y = rays_.rows[static_cast<std::size_t>(row)];
    std::size_t count = work.rays.count;
    for (int i = 0; i < length; ++i) {
      const FaceId face = faces[i];
      work.samples[count] = static_cast<std::uint32_t>(first) + static_cast<std::uint32_t>(i);
      work.faces[count] = static_cast<std::uint32_t>(face);
      work.rays.map_x[count] = x[i];
      work.rays.map_y[count] = y;
      count += face != kNoFace;  // no branch: edges of shapes are hard to predict
    }
    work.rays.count = count;
  }

  void collect_tile(const Tile& tile, Work& work) const {
    work.rays.count = 0;
    const int end_column = std::min(tile.column + kTile, grid_.columns());
    const int end_row = std::min(tile.row + kTile, grid_.rows());
    for (int left = tile.column; left < end_column; left += kBlockColumns) {
      for (int top = tile.row; top < end_row; top += kBlockRows) {
        for (int row = top; row < std::min(top + kBlockRows, end_row); ++row) {
          add_run(row, left, std::min(left + kBlockColumns, end_column), work);
        }
      }
    }
  }

  // One sample in each cell, at a place that varies so that no pattern of the picture hides from it.
  void collect_some(const Tile& tile, Work& work) const {
    work.rays.count = 0;
    for (int top = tile.row; top < tile.row + kTile; top += kCell) {
      for (int left = tile.column; left < tile.column + kTile; left += kCell) {
        const auto cell = static_cast<std::uint64_t>(top) << 32 | static_cast<std::uint64_t>(left);
        const int place = static_cast<int>(scrambled(cell) % (kCell * kCell));
        const int column = left + place % kCell, row = top + place / kCell;
        if (column < grid_.columns() && row < grid_.rows()) add_run(row, column, column + 1, work);
      }
    }
  }

  // Offsets of the batch's points from `origin`, to within `allowed` and the rounding of doubles.
  void find_offsets(const Vector& origin, double allowed, Work& work) const {
    const float K[3] = {camera_.x, camera_.y, camera_.z};
    simd::RayBatch& rays = work.rays;
    work.slots.assign(work.faces, rays.count, rays.slots);
    simd::set_up_planes(work.slots.planes, K);
    simd::ray_directions(rays_.frame, rays.map_x, rays.map_y, rays.count, rays.direction[0], rays.direction[1],
                         rays.direction[2]);
    const DVector from_origin = DVector(camera_) - DVector(origin);
    const double base[3] = {from_origin.x, from_origin.y, from_origin.z};
    if (!simd::meet_planes(work.slots.planes, base, allowed, rays, work.is_sharp)) return;
    for (std::size_t i = 0; i < rays.count; ++i) {
      if (!work.is_sharp[i]) sharpen(origin, i, work);
    }
  }

  void sharpen(const Vector& origin, std::size_t i, Work& work) const {
    simd::RayBatch& rays = work.rays;
    const Triangle face = triangle_of(scene_, work.faces[i]);
    const TruePoint point{
        camera_, {rays.direction[0][i], rays.direction[1][i], rays.direction[2][i]}, face, side(face, camera_)};
    const DVector offset = offset_from(origin, point, ray_parameter(point));
    for (int axis = 0; axis < 3; ++axis) rays.offset[axis][i] = offset[axis];
  }

  // ---- origin and step ----

  static Box box_of(const simd::RayBatch& rays) {
    Box box;
    for (int axis = 0; axis < 3; ++axis) {
      const auto [least, most] = std::minmax_element(rays.offset[axis], rays.offset[axis] + rays.count);
      box.lower[axis] = *least;
      box.upper[axis] = *most;
    }
    return box;
  }

  Box seen_box(const Vector& origin, double allowed, bool from_some) {
    std::vector<Box> boxes(bands());
    executor_.for_each(bands(), [&](std::size_t band, int worker) {
      Work& work = *work_[static_cast<std::size_t>(worker)];
      for (int column = 0; column < grid_.columns(); column += kTile) {
        const Tile tile{column, static_cast<int>(band) * kTile};
        if (from_some) {
          collect_some(tile, work);
        } else {
          collect_tile(tile, work);
        }
        if (work.rays.count == 0) continue;
        find_offsets(origin, allowed, work);
        boxes[band].add(box_of(work.rays));
      }
    });
    Box all;
    for (const Box& box : boxes) all.add(box);
    return all;
  }

  void place_box(bool from_some) {
    const Vector centre(scene_.centre());
    const double allowed = kGuessShare * farthest_;
    Box box = seen_box(centre, allowed, from_some);
    if (!(box.lower.x <= box.upper.x)) box = {DVector(0), DVector(0)};  // the few samples met nothing
    origin_ = Vector(DVector(centre) + (box.lower + box.upper) * 0.5);
    const DVector shift = DVector(centre) - DVector(origin_);
    double half = 0;
    for (int axis = 0; axis < 3; ++axis) {
      half = std::max({half, std::fabs(box.lower[axis] + shift[axis]), std::fabs(box.upper[axis] + shift[axis])});
    }
    step_ = power_of_two_above(half + allowed) * std::bit_cast<double>(std::uint64_t{1023 - kBoxBits} << 52);
    seen_.points.origin = DVector(origin_);
    seen_.points.step = step_;
    // Half a step for each coordinate (sqrt(3) / 2 < 0.8661), kSharpShare, and what meet_planes rounds: the base, the
    // product and the sum, each 2^-53 of a coordinate that is at most |K - O| + farthest.
    const double rounding = 0x1p-49 * (length(DVector(camera_) - DVector(origin_)) + farthest_);
    seen_.points.error = step_ * (0.8661 + kSharpShare) + rounding;
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
    std::size_t first = starts_[band];
    for (int column = 0; column < grid_.columns(); column += kTile) {
      collect_tile({column, static_cast<int>(band) * kTile}, work);
      if (work.rays.count == 0) continue;
      find_offsets(origin_, step_ * kSharpShare, work);
      if (!simd::round_offsets(work.rays, 1 / step_, work.coordinates[0], work.coordinates[1], work.coordinates[2])) {
        return false;
      }
      store_points(first, work);
      store_masks(first, work);
      for (std::size_t i = 0; i < (is_loose.empty() ? 0 : work.rays.count); ++i) {
        if (is_loose[work.samples[i] - first_of_band(band)]) loose.push_back(static_cast<std::uint32_t>(first + i));
      }
      first += work.rays.count;
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
    const std::size_t count = work.rays.count;
    std::memcpy(points.x.data() + first, work.coordinates[0], count * sizeof(std::int32_t));
    std::memcpy(points.y.data() + first, work.coordinates[1], count * sizeof(std::int32_t));
    std::memcpy(points.z.data() + first, work.coordinates[2], count * sizeof(std::int32_t));
    std::memcpy(points.samples.data() + first, work.samples, count * sizeof(std::uint32_t));
    std::memcpy(points.faces.data() + first, work.faces, count * sizeof(std::uint32_t));
  }

  void store_masks(std::size_t first, Work& work) {
    for (std::size_t byte = 0; byte < seen_.stride; ++byte) {
      find_facing(byte, work);
      std::uint8_t* masks = seen_.masks.data() + first * seen_.stride + byte;
      for (std::size_t i = 0; i < work.rays.count; ++i) {
        masks[i * seen_.stride] = static_cast<std::uint8_t>(work.facing[work.rays.slots[i]]);
      }
    }
  }

  // Which of the eight lights of a mask's byte each face of the batch is turned to as it is to the camera.
  void find_facing(std::size_t byte, Work& work) const {
    const std::size_t first = byte * 8;
    const int count = static_cast<int>(std::min<std::size_t>(8, lights_.size() - first));
    float positions[8][3];
    for (int l = 0; l < count; ++l) {
      const Vector& light = lights_[first + static_cast<std::size_t>(l)];
      for (int axis = 0; axis < 3; ++axis) positions[l][axis] = light[axis];
    }
    simd::find_facing(work.slots.planes, positions, count, work.facing, work.unsure);
    for (std::size_t slot = 0; slot < work.slots.planes.count; ++slot) {
      if (work.unsure[slot] == 0) continue;
      for (int l = 0; l < count; ++l) {
        if ((work.unsure[slot] >> l & 1) == 0) continue;
        if (is_facing(work.slots.faces[slot], first + static_cast<std::size_t>(l), work)) work.facing[slot] |= 1 << l;
      }
    }
  }

  // Exactly, and once for each face, light and thread: a large face in a light's plane is asked about in many batches.
  bool is_facing(std::uint32_t face, std::size_t light, Work& work) const {
    const auto [entry, is_new] = work.sides.try_emplace(static_cast<std::uint64_t>(face) * lights_.size() + light, 0);
    if (is_new) {
      const Triangle triangle = triangle_of(scene_, face);
      entry->second = side(triangle, camera_) * side(triangle, lights_[light]);
    }
    return entry->second > 0;
  }

  const Scene& scene_;
  const SampleGrid& grid_;
  const NearestFaces& nearest_;
  const std::vector<Vector>& lights_;
  const Executor& executor_;
  const RayTable rays_;
  const Vector camera_;
  double farthest_ = 0;  // the camera's distance from any seen point is at most this
  std::vector<std::unique_ptr<Work>> work_;
  std::vector<std::size_t> starts_;
  Vector origin_{0};
  double step_ = 1;
  SeenPoints seen_;
};

}  // namespace

SeenPoints find_seen_points(const Scene& scene, const SampleGrid& grid, const NearestFaces& nearest,
                            const std::vector<Vector>& lights, const Executor& executor) {
  return PointFinder(scene, grid, nearest, lights, executor).find();
}

}  // namespace facemap
