#pragma once

#include <facemap/scene.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "map/face_planes.h"
#include "map/filter_direction.h"
#include "math/exact_sign.h"

namespace facemap {

/// Which listed faces a ray from a map's origin meets: the float32 filter first, the exact test where it does not
/// tell.
struct RayTests {
  const Scene& scene;
  const FacePlanesTable& planes;
  const Vector& O;
  const Vector& d;
  Counters* counters = nullptr;
  FilterDirection filter{d};

  /// Entries given to the filter at a time: lists are front to back, and most rays end within the first few.
  static constexpr std::size_t kChunk = 16;

  /// Bounds of how far along filter.d, in map units, the plane of a face is that is met: what the face's plane in
  /// float32 tells. The first may be negative, the second infinite, either no number.
  struct Range {
    double low, high;
  };
  Range range_of(std::uint32_t id) const {
    constexpr double kRounding = 0x1p-40;  // of what follows, relative, with a wide reserve
    const simd::FacePlanes& p = planes.planes()[id];
    const double slope = double{p.x[3]} * double{filter.d[0]} + double{p.y[3]} * double{filter.d[1]} +
                         double{p.z[3]} * double{filter.d[2]};
    const double error = double{p.error} * double{filter.length} + double{simd::kUnderflow};
    const double offset = p.offset, offset_error = p.offset_error;
    return {(offset - offset_error) / (slope + error) * (1 - kRounding),
            slope > error ? (offset + offset_error) / (slope - error) * (1 + kRounding) : HUGE_VAL};
  }

  /// Calls visit(id, covering) for each of the faces that is met, until ends(id) says of one that begins a chunk that
  /// it and those behind it do not matter.
  template <class Ends, class Visit>
  void for_each_met(std::span<const std::uint32_t> ids, const Ends& ends, const Visit& visit) const {
    simd::Verdict verdicts[kChunk];
    for (std::size_t first = 0; first < ids.size(); first += kChunk) {
      const std::span<const std::uint32_t> chunk = ids.subspan(first, std::min(kChunk, ids.size() - first));
      if (ends(chunk[0])) return;
      simd::cone_verdicts(planes.planes(), chunk.data(), chunk.size(), filter.d, filter.length, verdicts);
      for (std::size_t i = 0; i < chunk.size(); ++i) {
        if (verdicts[i] != simd::kUndecided && counters != nullptr) ++counters->by_float;
        if (verdicts[i] == simd::kNo) continue;
        const bool is_sure = verdicts[i] == simd::kYes;
        const Covering covering = is_sure ? Covering{true, true}
                                          : covers(triangle_of(scene, chunk[i]), planes.side(chunk[i]), O, d, counters);
        if (covering.hit) visit(chunk[i], covering);
      }
    }
  }
};

}  // namespace facemap
