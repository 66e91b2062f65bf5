#pragma once

#include <facemap/counters.h>
#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "picture/asked_points.h"
#include "picture/shadows.h"
#include "picture/texel_lists.h"
#include "picture/unset_vector.h"

namespace facemap {

/// Points of a light's raster, and where they lie on that of its lists (simd::OpenPlaces). Working memory of ask_lists.
struct PointsOnLists {
  std::vector<std::uint32_t> numbers;
  std::vector<std::uint32_t> texels;
  std::vector<std::uint32_t> depths;
  std::vector<simd::OpenPair> pairs;
  std::vector<std::uint8_t> verdicts;  // of pairs of given points

  std::size_t memory_bytes() const noexcept;
};

/// Whether the filter's bounds hold for the faces of a scene and points whose offsets from the light have no sum of
/// components greater than `size`.
bool can_ask_lists(const Scene& scene, const Vector& light, double size);

/// Whether lists are the quicker way for so many points that ask about a light: faces that run over sorted points take
/// the less time a point the more points there are, lists always the same.
bool are_lists_quicker(std::size_t points, std::size_t faces);

/// Clears the bit in mask.lit of each listed point that a face of its texel's list blocks. `dark`: one byte a point, 0
/// for the listed ones. Returns how many points and faces were held against each other.
std::size_t ask_lists(const Scene& scene, const Vector& light, const TexelLists& lists, const AskedPoints& points,
                      const MaskBit& mask, const BlocksExactly& blocks_exactly, PointsOnLists& listed,
                      UnsetVector<std::uint8_t>& dark, Counters& counters);

}  // namespace facemap
