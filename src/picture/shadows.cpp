#include "picture/shadows.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>

#include "math/dvector.h"
#include "picture/gnomonic.h"
#include "picture/point_projection.h"
#include "picture/shadow_faces.h"
#include "picture/shadow_points.h"
#include "picture/shadow_rest.h"
#include "simd/floating_point_mode.h"
#include "simd/shadow_sides.h"

namespace facemap {

struct ShadowScratch::Parts {
  std::vector<std::uint8_t> wanted;  ///< one a point: a bit for each side of the light that is to place it
  std::vector<std::uint32_t> rest;
  ShadowPoints points;
  ShadowFaces faces;
};

ShadowScratch::ShadowScratch() : parts_(std::make_unique<Parts>()) {}
ShadowScratch::~ShadowScratch() = default;
ShadowScratch::ShadowScratch(ShadowScratch&&) noexcept = default;
ShadowScratch& ShadowScratch::operator=(ShadowScratch&&) noexcept = default;

std::size_t ShadowScratch::memory_bytes() const noexcept {
  return sizeof(Parts) + parts_->wanted.capacity() + parts_->rest.capacity() * sizeof(std::uint32_t) +
         parts_->points.memory_bytes() + parts_->faces.memory_bytes();
}

namespace {

// Kernels read this much past the end of `wanted`.
constexpr std::size_t kPadding = 64;

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
    const simd::WantedPoints wanted = find_wanted();
    if (wanted.count == 0) return;
    parts_.rest.clear();
    if (scene_.mesh().positions.size() > kMostVertices) {
      add_all_to_rest();
      return ask_rest();
    }
    const auto offset = [&](const std::int32_t* q) { return from_light_ + points_.step * DVector(q[0], q[1], q[2]); };
    const OffsetBox box{offset(wanted.lower), offset(wanted.upper)};
    size_ = 0;
    for (int k = 0; k < 3; ++k) {
      size_ += std::fabs(from_light_[k]) + points_.step * std::max(std::fabs(static_cast<double>(wanted.lower[k])),
                                                                   std::fabs(static_cast<double>(wanted.upper[k])));
    }
    if (auto frame = frame_towards(light_, box, PointProjection(points_, light_, size_).error)) {
      if (is_longer_along_v(scene_, *frame)) frame = turned(*frame);
      run_frame(*frame, 1, wanted.count, nearest_of(*frame, box));
    } else {
      run_sides(box);
    }
    ask_rest();
  }

  const Counters& counters() const { return counters_; }

 private:
  // Sets wanted[] to 1 where the point's bit is set.
  simd::WantedPoints find_wanted() {
    const std::size_t count = points_.size(), stride = mask_.stride;
    parts_.wanted.resize(count + kPadding);
    const std::uint8_t* masks = mask_.asked + mask_.bit / 8;
    std::uint8_t* wanted = parts_.wanted.data();
    const int shift = mask_.bit % 8;
    const auto bit = [=](std::uint8_t mask) { return static_cast<std::uint8_t>(mask >> shift & 1); };
    if (stride == 1) {
      for (std::size_t i = 0; i < count; ++i) wanted[i] = bit(masks[i]);
    } else {
      for (std::size_t i = 0; i < count; ++i) wanted[i] = bit(masks[i * stride]);
    }
    return simd::measure_wanted(points_.x.data(), points_.y.data(), points_.z.data(), wanted, count);
  }

  double nearest_of(const simd::ShadowFrame& frame, const OffsetBox& box) const {
    double nearest = 0;
    for (int k = 0; k < 3; ++k) nearest += std::min(frame.rows[2][k] * box.lower[k], frame.rows[2][k] * box.upper[k]);
    return nearest;
  }

  void run_sides(const OffsetBox& box) {
    double reach = 0;
    for (int k = 0; k < 3; ++k) reach = std::max({reach, std::fabs(box.lower[k]), std::fabs(box.upper[k])});
    if (!(reach > 0)) return add_all_to_rest();
    simd::ShadowFrame frame = frame_of_side(light_, 4, reach);
    for (int k = 0; k < 3; ++k) frame.rows[k][k] = 1 / reach;  // plain offsets: the sides' rims are wider than rounding
    const simd::SideCounts counts = simd::split_by_side(
        PointProjection(points_, light_, size_).onto(frame, 1, parts_.wanted.data(), 1), parts_.wanted.data());
    for (int side = 0; side < simd::kSides; ++side) {
      if (counts.of[side] == 0) continue;
      run_frame(frame_of_side(light_, side, reach), static_cast<std::uint8_t>(1u << side), counts.of[side], 0);
    }
  }

  // `nearest`: the least Z of the points, or 0: not known.
  void run_frame(const simd::ShadowFrame& frame, std::uint8_t bit, std::size_t wanted, double nearest) {
    const PointProjection projection(points_, light_, size_);
    // A little more than the nearest point needs, so that rounding does not leave it out.
    const double slack =
        std::clamp(projection.error_in(frame) / nearest * 0x1.01p24, kLeastSlack, simd::kShadowGreatestSlack);
    parts_.points.sort(projection.onto(frame, slack, parts_.wanted.data(), bit), wanted, scene_.face_count(),
                       parts_.rest);
    if (parts_.points.count() > 0) {
      parts_.faces.run({scene_, light_, frame, slack, skip_entries_, some_, blocks_exactly_}, parts_.points, counters_);
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

  void add_all_to_rest() {
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (parts_.wanted[i] != 0) parts_.rest.push_back(static_cast<std::uint32_t>(i));
    }
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

void clear_blocked(const Scene& scene, const Vector& light, const AskedPoints& points, const MaskBit& mask,
                   const std::uint8_t* skip_entries, const BlocksExactly& blocks_exactly, ShadowScratch& scratch,
                   Counters* counters, const std::vector<std::uint32_t>* some) {
  const FloatingPointMode mode;
  LightPass pass(scene, light, points, mask, skip_entries, some, blocks_exactly, scratch.parts());
  pass.run();
  if (counters != nullptr) *counters += pass.counters();
}

}  // namespace facemap
