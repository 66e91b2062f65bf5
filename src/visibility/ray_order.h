#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "parallel/executor.h"

namespace facemap {

/// An order of rays in which those after one another ask the same faces: of very many rays in any order, each would
/// else wait for memory.
class RayOrder {
 public:
  /// By cell_of(i), which is below `cells`; as they come if they are few, or come in runs of one cell already.
  RayOrder(const Executor& executor, std::size_t count, std::size_t cells,
           const std::function<std::uint32_t(std::size_t)>& cell_of);

  /// The number of the ray at a place of the order.
  std::size_t operator[](std::size_t place) const { return order_.empty() ? place : order_[place]; }

 private:
  std::vector<std::uint32_t> order_;  // none: as they come
};

}  // namespace facemap
