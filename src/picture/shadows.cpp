#include "picture/shadows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>

#include "math/dvector.h"
#include "picture/bytes_of.h"
#include "picture/gnomonic.h"
#include "picture/point_list.h"
#include "picture/point_projection.h"
#include "picture/shadow_faces.h"
#include "picture/shadow_points.h"
#include "picture/shadow_rest.h"
#include "simd/floating_point_mode.h"
#include "simd/shadow_sides.h"

namespace facemap {

struct ShadowScratch::Parts {
  WorkingMemory memory;
  std::vector<std::uint8_t> sides;  ///< of a light among the points: one bit a point that is asked
  std::vector<std::uint32_t> rest;
  ShadowPoints points;
  ShadowFaces faces;
};

ShadowScratch::ShadowScratch() : parts_(std::make_unique<Parts>()) {}
ShadowScratch::~ShadowScratch() = default;
ShadowScratch::ShadowScratch(ShadowScratch&&) noexcept = default;
ShadowScratch& ShadowScratch::operator=(ShadowScratch&&) noexcept = default;

std::size_t ShadowScratch::memory_bytes() const noexcept {
  return sizeof(Parts) + parts_->memory.memory_bytes() + bytes_of(parts_->sides) + bytes_of(parts_->rest) +
         parts_->points.memory_bytes() + parts_->faces.memory_bytes();
}

namespace {

// The least error of a point's X, Y and Z, in units of 2^-24 Z, that the filter is told of: it costs nothing to speak
// of. Points nearer to the light than the greatest allows are asked singly.
constexpr double kLeastSlack = 0x1p-4;

// Vertices are gathered by 32-bit numbers of floats.
constexpr std::size_t kMostVertices = std::size_t{1} << 29;

// So many faces are looked at to learn which way faces are long.
constexpr std::size_t kSampledFaces = 1024;

// Whether faces are longer along v than along u, as their boxes on the raster's plane go. A row of texels along which
// they are long holds them in fewer runs of points.
bool is_longer_along_v(const Scene& scene, const simd::ShadowFrame& frame) {
  const Mesh& mesh = scene.mesh();
  double along_u = 0, along_v = 0;
  for (std::size_t face = 0; face < mesh.face_count(); face += mesh.face_count() / kSampledFaces + 1) {
    DVector lower(1), upper(-1);
    bool is_in_front = true;
    for (int k = 0; k < 3; ++k) {
      const Vector& corner = mesh.vertex(face, k);
      DVector place(0);  // X, Y, Z
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) place[i] += frame.rows[i][j] * (double{corner[j]} - frame.light[j]);
      }
      is_in_front = is_in_front && place.z > 0;
      lower = glm::min(lower, place / place.z);
      upper = glm::max(upper, place / place.z);
    }
    if (!is_in_front) continue;
    along_u += std::max(0.0, std::min(upper.x, 1.0) - std::max(lower.x, -1.0));
    along_v += std::max(0.0, std::min(upper.y, 1.0) - std::max(lower.y, -1.0));
  }
  return along_v > along_u;
}

class LightPass {
 public:
  LightPass(const Scene& scene, const Vector& light, const AskedPoints& points, const MaskBit& mask,
            const std::uint8_t* skip_entries, const std::vector<std::uint32_t>* some,
            const BlocksExactly& blocks_exactly, ShadowScratch::Parts& parts)
      : scene_(scene),
        light_(light),
        points_(points),
        mask_(mask),
        skip_entries_(skip_entries),
        some_(some),
        blocks_exactly_(blocks_exactly),
        parts_(parts),
        from_light_(points.origin - DVector(light)) {}

  void run() {
    if (points_.size() == 0) return;  // then there may be no masks either
    const std::size_t most = mask_.most != 0 ? mask_.most : count_asked();
    if (most == 0) return;
    parts_.memory.start();
    parts_.memory.require(bytes_of_list(most));
    simd::ListedPoints list = list_in(parts_.memory, most);
    const simd::WantedBits wanted{mask_.asked + mask_.bit / 8, mask_.stride,
                                  static_cast<std::uint8_t>(1u << (mask_.bit % 8))};
    const simd::ListedBox listed = simd::list_wanted(arrays_of(points_), wanted, list);
    if (list.count == 0) return;
    parts_.rest.clear();
    if (scene_.mesh().positions.size() > kMostVertices) {
      add_to_rest(list);
      return ask_rest();
    }
    const auto offset = [&](const std::int32_t* q) { return from_light_ + points_.step * DVector(q[0], q[1], q[2]); };
    const OffsetBox box{offset(listed.lower), offset(listed.upper)};
    size_ = 0;
    for (int k = 0; k < 3; ++k) {
      size_ += std::fabs(from_light_[k]) + points_.step * std::max(std::fabs(static_cast<double>(listed.lower[k])),
                                                                   std::fabs(static_cast<double>(listed.upper[k])));
    }
    if (auto frame = frame_towards(light_, box, PointProjection(points_, light_, size_).error)) {
      if (is_longer_along_v(scene_, *frame)) frame = turned(*frame);
      parts_.memory.require(ShadowPoints::bytes_for(most, scene_.face_count()));
      run_frame(*frame, list, nearest_of(*frame, box));
    } else {
      run_sides(box, list);
    }
    ask_rest();
  }

  const Counters& counters() const { return counters_; }

 private:
  std::size_t count_asked() const {
    std::size_t counts[8] = {};
    simd::count_wanted(mask_.asked + mask_.bit / 8, mask_.stride, points_.size(), counts);
    return counts[mask_.bit % 8];
  }

  double nearest_of(const simd::ShadowFrame& frame, const OffsetBox& box) const {
    double nearest = 0;
    for (int k = 0; k < 3; ++k) nearest += std::min(frame.rows[2][k] * box.lower[k], frame.rows[2][k] * box.upper[k]);
    return nearest;
  }

  void run_sides(const OffsetBox& box, const simd::ListedPoints& list) {
    double reach = 0;
    for (int k = 0; k < 3; ++k) reach = std::max({reach, std::fabs(box.lower[k]), std::fabs(box.upper[k])});
    if (!(reach > 0)) return add_to_rest(list);
    simd::ShadowFrame frame = frame_of_side(light_, 4, reach);
    for (int k = 0; k < 3; ++k) frame.rows[k][k] = 1 / reach;  // plain offsets: the sides' rims are wider than rounding
    const simd::SideCounts counts = split(list, PointProjection(points_, light_, size_).through(frame, 1));
    const std::size_t most = *std::max_element(counts.of, counts.of + simd::kSides);
    for (int side = 0; side < simd::kSides; ++side) {
      if (counts.of[side] == 0) continue;
      parts_.memory.start();  // the list of all is not needed any more
      parts_.memory.require(bytes_of_list(most));
      simd::ListedPoints of_side = list_in(parts_.memory, counts.of[side]);
      simd::list_wanted(arrays_of(points_), {parts_.sides.data(), 1, static_cast<std::uint8_t>(1u << side)}, of_side);
      parts_.memory.require(ShadowPoints::bytes_for(most, scene_.face_count()));
      run_frame(frame_of_side(light_, side, reach), of_side, 0);
    }
  }

  // Sets the bit of its side for each point of the list.
  simd::SideCounts split(const simd::ListedPoints& list, const simd::PointTransform& transform) {
    auto* const bits = parts_.memory.take<std::uint8_t>(list.count + simd::kListPadding);
    const simd::SideCounts counts = simd::split_by_side(list, transform, bits);
    parts_.sides.assign(points_.size(), 0);
    for (std::size_t k = 0; k < list.count; ++k) parts_.sides[list.numbers[k]] = bits[k];
    return counts;
  }

  // `nearest`: the least Z of the points, or 0: not known.
  void run_frame(const simd::ShadowFrame& frame, const simd::ListedPoints& list, double nearest) {
    const PointProjection projection(points_, light_, size_);
    // A little more than the nearest point needs, so that rounding does not leave it out.
    const double slack =
        std::clamp(projection.error_in(frame) / nearest * 0x1.01p24, kLeastSlack, simd::kShadowGreatestSlack);
    parts_.points.sort(list, projection.through(frame, slack), points_.faces.data(), scene_.face_count(), parts_.memory,
                       parts_.rest);
    if (parts_.points.count() > 0) {
      parts_.faces.run({scene_, light_, frame, slack, skip_entries_, some_, points_.given, blocks_exactly_},
                       parts_.points, counters_);
      clear_blocked_places();
    }
  }

  void clear_blocked_places() {
    const std::unique_lock lock = mask_.hold();
    const ShadowPoints& points = parts_.points;
    for (std::uint32_t first = 0; first < points.count(); first += 16) {
      for (std::uint32_t blocked = points.blocked_from(first); blocked != 0; blocked &= blocked - 1) {
        mask_.clear(points.point_at(first + static_cast<std::uint32_t>(std::countr_zero(blocked))));
      }
    }
  }

  void add_to_rest(const simd::ListedPoints& list) {
    parts_.rest.insert(parts_.rest.end(), list.numbers, list.numbers + list.count);
  }

  void ask_rest() {
    const auto blocked = find_blocked_singly(scene_, light_, points_, parts_.rest, blocks_exactly_, &counters_);
    const std::unique_lock lock = mask_.hold();
    for (const std::uint32_t point : blocked) mask_.clear(point);
  }

  const Scene& scene_;
  const Vector& light_;
  const AskedPoints& points_;
  const MaskBit& mask_;
  const std::uint8_t* skip_entries_;
  const std::vector<std::uint32_t>* some_;
  const BlocksExactly& blocks_exactly_;
  ShadowScratch::Parts& parts_;
  const DVector from_light_;  // to the points' origin
  double size_ = 0;           // bound of |offset|_1 as it is summed
  Counters counters_;
};

}  // namespace

std::size_t most_asked(const std::vector<std::uint8_t>& asked, std::size_t stride) {
  std::size_t most = 0;
  for (std::size_t byte = 0; byte < stride; ++byte) {
    std::size_t counts[8] = {};
    simd::count_wanted(asked.data() + byte, stride, asked.size() / stride, counts);
    most = std::max(most, *std::max_element(counts, counts + 8));
  }
  return most;
}

void clear_blocked(const Scene& scene, const Vector& light, const AskedPoints& points, const MaskBit& mask,
                   const std::uint8_t* skip_entries, const BlocksExactly& blocks_exactly, ShadowScratch& scratch,
                   Counters* counters, const std::vector<std::uint32_t>* some) {
  const FloatingPointMode mode;
  LightPass pass(scene, light, points, mask, skip_entries, some, blocks_exactly, scratch.parts());
  pass.run();
  if (counters != nullptr) *counters += pass.counters();
}

}  // namespace facemap
