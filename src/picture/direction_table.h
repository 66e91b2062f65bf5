#pragma once

#include <facemap/vector.h>

#include <cstddef>
#include <memory>

#include "picture/unset_vector.h"

namespace facemap {

class Executor;
struct SampleGrid;

/// Directions of all rays of a grid, one a sample, row by row: how lenses without a kernel of their own are used. Zero
/// where there is none.
struct DirectionTable {
  UnsetVector<float> x, y, z;

  Vector at(std::size_t sample) const { return Vector(x[sample], y[sample], z[sample]); }

  static constexpr std::size_t kBytesPerSample = 12;
};

/// The bits of SampleGrid::direction, which need not have a table.
std::shared_ptr<const DirectionTable> make_directions(const SampleGrid& grid, const Executor& executor);

}  // namespace facemap
