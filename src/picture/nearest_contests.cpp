#include "picture/nearest_contests.h"

#include <algorithm>

#include "map/face_planes.h"
#include "map/nearest_hit.h"
#include "math/exact_sign.h"

// Why the nearest face T of a sample is the raster's winner or among the contests that are asked here. If its cover is
// unsure or its depth not sharp, it was contested unless surely behind a face that surely covers the sample: it is not.
// Else it was drawn. Every w that the sample held is at most the last one, which T's w is close to or above, T being
// nearest; so when T met a greater one, or a greater one came, the two were close, and the smaller was contested. The
// same holds for every face at exactly T's depth, so ties are seen; and for every face not surely behind the last
// winner, so that the pairs left after dropping those that are do not depend on the order of drawing.
namespace facemap {
namespace {

std::uint32_t face_of(const simd::Contest& contest) { return contest.face & ~simd::Contest::kUnsureCover; }

void meet(NearestHit& best, const Scene& scene, const Vector& origin, const Vector& direction, std::uint32_t face,
          bool surely_covers, Counters* counters) {
  const Triangle triangle = triangle_of(scene, face);
  const int s = side(triangle, origin, counters);
  if (s == 0) return;
  if (surely_covers) {
    best.meet(face, s, true);
    return;
  }
  const Covering covering = covers(triangle, s, origin, direction, counters);
  if (covering.hit) best.meet(face, s, covering.strictly_inside);
}

}  // namespace

void resolve_contests(const Scene& scene, const SampleGrid& grid, const RasterPlace& place,
                      const simd::RasterTarget& target, std::vector<std::uint32_t>& loose, Counters* counters) {
  simd::Contests& contests = *target.contests;
  std::erase_if(contests,
                [&](const simd::Contest& c) { return c.largest_w < target.w[c.sample] * simd::kSurelyBehind; });
  std::sort(contests.begin(), contests.end(), [](const simd::Contest& a, const simd::Contest& b) {
    return a.sample != b.sample ? a.sample < b.sample : face_of(a) < face_of(b);
  });
  const Vector origin = grid.frame.position();
  for (std::size_t i = 0; i < contests.size();) {
    const std::uint32_t sample = contests[i].sample;
    const int column = place.first_column + static_cast<int>(sample % target.columns);
    const int row = place.first_row + static_cast<int>(sample / target.columns);
    const Vector direction = grid.direction(column, row);
    NearestHit best(scene, origin, direction, counters);
    // In the order of ids, so that counts are the same however the faces came.
    std::int64_t winner = target.faces[sample];
    const auto meet_winner = [&] {
      if (winner >= 0) meet(best, scene, origin, direction, static_cast<std::uint32_t>(winner), true, counters);
      winner = kNoFace;
    };
    for (; i < contests.size() && contests[i].sample == sample; ++i) {
      const std::uint32_t face = face_of(contests[i]);
      if (winner < face) meet_winner();
      meet(best, scene, origin, direction, face, face == contests[i].face, counters);
    }
    meet_winner();
    target.faces[sample] = best.hit().face;
    if (!best.hit() || (best.hit().strictly_inside && !best.hit().tied)) continue;
    loose.push_back(static_cast<std::uint32_t>(row) * static_cast<std::uint32_t>(grid.columns()) +
                    static_cast<std::uint32_t>(column));
  }
}

}  // namespace facemap
