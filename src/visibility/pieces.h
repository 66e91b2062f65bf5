#pragma once

#include <algorithm>
#include <cstddef>

#include "parallel/executor.h"
#include "visibility/told_progress.h"

namespace facemap {

/// Calls body(first, last, piece) for pieces of 0..count-1 of `size` elements each (the last may be shorter), on all
/// threads, and tells what is done after each.
template <class Body>
void for_pieces(const Executor& executor, std::size_t count, std::size_t size, const Viewpoint::Progress& progress,
                const Body& body) {
  ToldProgress told(progress, count);
  const auto task = [&](std::size_t piece, int) {
    const std::size_t first = piece * size, last = std::min(first + size, count);
    body(first, last, piece);
    told.add(last - first);
  };
  const std::size_t pieces = count / size + (count % size != 0);
  if (pieces == 1) return task(0, 0);
  executor.for_each(pieces, task);
}

}  // namespace facemap
