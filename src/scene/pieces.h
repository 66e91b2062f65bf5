#pragma once

#include <algorithm>
#include <cstddef>

#include "parallel/executor.h"

namespace facemap {

/// 0..count-1 cut into pieces of at least `least` elements, at most four a thread: where tasks need to know which
/// piece they have.
class Pieces {
 public:
  Pieces(const Executor& executor, std::size_t count, std::size_t least)
      : count_(count),
        size_(executor.threads() == 1
                  ? 1
                  : std::clamp<std::size_t>(count / least, 1, 4 * static_cast<std::size_t>(executor.threads()))) {}

  std::size_t size() const { return size_; }
  std::size_t begin(std::size_t piece) const { return count_ / size_ * piece + std::min(piece, count_ % size_); }
  std::size_t end(std::size_t piece) const { return begin(piece + 1); }
  /// The same as begin, to add to an iterator.
  std::ptrdiff_t offset(std::size_t piece) const { return static_cast<std::ptrdiff_t>(begin(piece)); }

 private:
  std::size_t count_, size_;
};

}  // namespace facemap
