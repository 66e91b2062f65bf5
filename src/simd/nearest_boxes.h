#pragma once

#include <cstddef>
#include <cstdint>

#include "simd/nearest_vertices.h"

namespace facemap::simd {

/// How points become boxes of samples.
struct BoxRules {
  float first_column, first_row;  ///< u and v of column and row 0
  float margin;                   ///< samples: a point's error and how far a ray may pass from its sample's centre
  float edge_u, edge_v;           ///< as VertexFrame, and a point's error more
  std::int32_t columns, rows;

  /// Edges that are not straight: they leave the box of their ends by at most bulge times the box's squared diagonal,
  /// if that is not above longest_squared. Larger faces have no box.
  float bulge = 0;
  float longest_squared = kNoLongest;
  static constexpr float kNoLongest = 3e38f;
};

/// Faces and the samples each may cover, both ends inside.
struct BoxQueue {
  std::uint32_t* faces;
  std::int32_t *x0, *x1, *y0, *y1;
  std::size_t size;
};

/// Boxes of at most this many samples share a queue, so that 16 faces are done at about the same time; larger ones
/// come last. The first queues are for boxes drawn whole, the next for spans of rows in lanes.
inline constexpr int kSmallQueues = 6, kLastBoxQueue = 1, kLastThinQueue = 4;
inline constexpr float kQueueSamples[kSmallQueues] = {1, 4, 12, 40, 120, 0x1p14f};

/// Boxes of the triangles [first, first + count), three indices each, whose vertices have `points`. Faces that no
/// sample can see are left out. Each queue needs room for count + kVertexRoom more.
void find_boxes(const std::uint32_t* triangles, std::size_t first, std::size_t count, const float* points,
                const BoxRules& rules, BoxQueue* queues);

}  // namespace facemap::simd
