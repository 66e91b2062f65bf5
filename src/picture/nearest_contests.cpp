#include "picture/nearest_contests.h"

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "map/face_planes.h"
#include "map/nearest_hit.h"
#include "math/exact_sign.h"
#include "picture/coplanar_pairs.h"
#include "simd/nearest_draw.h"

// Why the nearest face T of a sample is the raster's winner or among the contests that are asked here. If its cover is
// unsure or its depth not sharp, it was contested unless surely behind a face that surely covers the sample: it is not.
// Else it was drawn. Every w that the sample held is at most the last one, which T's w is close to or above, T being
// nearest; so when T met a greater one, or a greater one came, the two were close, and the smaller was contested. The
// same holds for every face at exactly T's depth, so ties are seen; and for every face not surely behind the last
// winner, so that the pairs left after dropping those that are do not depend on the order of drawing.
namespace facemap {
namespace {

std::uint32_t face_of(const simd::Contest& contest) { return contest.face & ~simd::Contest::kUnsureCover; }
bool surely_covers(const simd::Contest& contest) { return (contest.face & simd::Contest::kUnsureCover) == 0; }

// Fewer are sorted by comparison.
constexpr std::size_t kLeastRadix = 1024;

// By sample, three digits of 11 bits: where faces lie on each other there may be one contest a sample and more.
void sort_by_sample(simd::Contests& contests) {
  if (contests.size() < kLeastRadix) {
    std::sort(contests.begin(), contests.end(), [](const auto& a, const auto& b) { return a.sample < b.sample; });
    return;
  }
  constexpr int kBits = 11;
  constexpr std::uint32_t kMask = (1u << kBits) - 1;
  simd::Contests sorted(contests.size());
  for (int shift = 0; shift < 32; shift += kBits) {
    std::array<std::size_t, kMask + 2> starts{};
    for (const simd::Contest& c : contests) ++starts[((c.sample >> shift) & kMask) + 1];
    for (std::size_t i = 1; i < starts.size(); ++i) starts[i] += starts[i - 1];
    for (const simd::Contest& c : contests) sorted[starts[(c.sample >> shift) & kMask]++] = c;
    contests.swap(sorted);
  }
}

class Judge {
 public:
  Judge(const Scene& scene, const Vector& origin, Counters* counters)
      : scene_(scene), origin_(origin), counters_(counters), coplanar_(scene) {}

  /// The pairs of one sample, in the order of ids, so that counts are the same however the faces came.
  Camera::Hit nearest(std::span<const simd::Contest> faces, const Vector& direction) {
    NearestHit best(scene_, origin_, direction, counters_);
    for (const simd::Contest& c : faces) {
      const Triangle triangle = triangle_of(scene_, face_of(c));
      const int s = side_of(face_of(c));
      if (s == 0) continue;
      const Covering covering =
          surely_covers(c) ? Covering{true, true} : covers(triangle, s, origin_, direction, counters_);
      if (covering.hit) best.meet(face_of(c), s, covering.strictly_inside);
    }
    return best.hit();
  }

  /// The same where all lie in one plane and surely cover the sample, whatever its direction.
  std::optional<Camera::Hit> tie_of(std::span<const simd::Contest> faces) {
    if (faces.size() < 2) return std::nullopt;
    for (const simd::Contest& c : faces) {
      if (!surely_covers(c)) return std::nullopt;
    }
    for (const simd::Contest& c : faces.subspan(1)) {
      if (!coplanar_.are_coplanar(face_of(faces[0]), face_of(c))) return std::nullopt;
    }
    Camera::Hit hit;
    hit.tied = hit.strictly_inside = true;
    for (const simd::Contest& c : faces) {
      const int s = side_of(face_of(c));
      if (s == 0) return std::nullopt;
      if (hit && s >= hit.side) continue;
      hit.face = static_cast<FaceId>(face_of(c));
      hit.side = s;
    }
    return hit;
  }

 private:
  // Neighbouring samples ask about the same few faces. Not counted, as that would depend on what is still known.
  int side_of(std::uint32_t face) {
    KnownSide& known = sides_[face % kKnownSides];
    if (!known.is_known || known.face != face) known = {face, side(triangle_of(scene_, face), origin_), true};
    return known.side;
  }

  struct KnownSide {
    std::uint32_t face = 0;
    int side = 0;
    bool is_known = false;
  };
  static constexpr std::size_t kKnownSides = 64;

  const Scene& scene_;
  Vector origin_;
  Counters* counters_;
  CoplanarPairs coplanar_;
  std::array<KnownSide, kKnownSides> sides_;
};

}  // namespace

std::size_t resolve_contests(const Scene& scene, const SampleGrid& grid, const RasterPlace& place,
                             const simd::RasterTarget& target, std::vector<std::uint32_t>& loose, Counters* counters) {
  simd::draw_waiting(target);
  simd::Contests& contests = *target.contests;
  std::erase_if(contests,
                [&](const simd::Contest& c) { return c.largest_w < target.w[c.sample] * simd::kSurelyBehind; });
  if (contests.empty()) return 0;
  sort_by_sample(contests);
  Judge judge(scene, grid.frame.position(), counters);
  simd::Contests faces;
  std::size_t contested = 0;
  for (std::size_t i = 0; i < contests.size(); ++contested) {
    const std::uint32_t sample = contests[i].sample;
    faces.clear();
    for (; i < contests.size() && contests[i].sample == sample; ++i) faces.push_back(contests[i]);
    if (target.w[sample] > 0) faces.push_back({sample, static_cast<std::uint32_t>(target.faces[sample]), 0});
    std::sort(faces.begin(), faces.end(), [](const auto& a, const auto& b) { return face_of(a) < face_of(b); });

    const int column = place.first_column + simd::column_of(target.row_samples, sample);
    const int row = place.first_row + simd::row_of(target.row_samples, sample);
    const std::optional<Camera::Hit> tie = judge.tie_of(faces);
    const Camera::Hit hit = tie ? *tie : judge.nearest(faces, grid.direction(column, row));
    target.faces[sample] = hit.face;
    target.w[sample] = 1;  // has a face, which may be kNoFace
    if (!hit || (hit.strictly_inside && !hit.tied)) continue;
    loose.push_back(static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(grid.columns()) +
                    static_cast<std::uint32_t>(column));
  }
  return contested;
}

}  // namespace facemap
