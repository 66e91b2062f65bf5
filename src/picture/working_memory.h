#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "picture/shared_pages.h"

namespace facemap {

/// Memory for arrays that stand one after the other and are given up together, kept for the next ones. What is in them
/// at first is of no meaning.
class WorkingMemory {
 public:
  /// Takes all back. There is room for `bytes` from now on.
  void start(std::size_t bytes) {
    if (pieces_.size() == 1) pieces_.back()->take_back();
    if (pieces_.size() == 1 && pieces_.back()->has_room(bytes)) return;
    const std::size_t held = memory_bytes();
    pieces_.clear();
    pieces_.push_back(std::make_unique<SharedPages>(std::max(bytes, held)));
  }

  /// Makes sure that there is room for `bytes` more, without moving what stands there.
  void require(std::size_t bytes) {
    if (pieces_.empty() || !pieces_.back()->has_room(bytes)) pieces_.push_back(std::make_unique<SharedPages>(bytes));
  }

  /// An array of `count` values.
  template <class Value>
  Value* take(std::size_t count) {
    require(SharedPages::room_for<Value>(count));
    return pieces_.back()->template take<Value>(count);
  }

  /// How much is taken.
  struct Mark {
    std::size_t pieces, taken;
  };
  Mark mark() const { return {pieces_.size(), pieces_.back()->taken()}; }

  /// Takes back what was taken since.
  void take_back_to(const Mark& mark) {
    pieces_.resize(mark.pieces);
    pieces_.back()->take_back_to(mark.taken);
  }

  std::size_t memory_bytes() const noexcept {
    std::size_t bytes = 0;
    for (const auto& piece : pieces_) bytes += piece->size();
    return bytes;
  }

 private:
  std::vector<std::unique_ptr<SharedPages>> pieces_;
};

}  // namespace facemap
