#pragma once

#include <facemap/counters.h>

#include <cstdint>
#include <vector>

#include "picture/ask_lists.h"
#include "picture/asked_points.h"
#include "picture/light_bounds.h"
#include "picture/shadows.h"
#include "picture/unset_vector.h"

namespace facemap {

/// Working memory of decide_points.
struct DecidedPoints {
  std::vector<std::uint8_t> asked;     ///< of a mask of several bytes a point, the one byte
  UnsetVector<std::uint8_t> dark;      ///< one a point: 1 where it is
  std::vector<std::uint32_t> numbers;  ///< of the other points that are open, ascending
  AskedPoints open;                    ///< those points, but for their samples
  PointsOnLists listed;                ///< open points that may ask the lists of the bounds instead

  /// The only faces that may block those points, or null: any may.
  const std::vector<std::uint32_t>* faces = nullptr;

  std::size_t memory_bytes() const noexcept;
};

/// No point's offset from the light is longer: coordinates have 32 bits.
double size_of_offsets(const AskedPoints& points, const Vector& light);

struct DecidedCount {
  std::size_t asked = 0, decided = 0;
};

/// For points whose bit is set in mask.asked: clears it in mask.lit where the light's bounds say that the point is
/// dark. Leaves in `work` the points about which they say nothing; `bounds` is to outlive work.faces. `asks_lists`:
/// those on the raster go to work.listed if the bounds have lists.
DecidedCount decide_points(const LightBounds& bounds, const Vector& light, const AskedPoints& points,
                           const MaskBit& mask, DecidedPoints& work, Counters& counters, bool asks_lists = true);

}  // namespace facemap
