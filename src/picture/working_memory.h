#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "picture/shared_pages.h"

namespace facemap {

/// Memory for arrays that are given up together, kept for the next ones. What is in them at first is of no meaning.
class WorkingMemory {
 public:
  /// Takes all back.
  void start() {
    for (const auto& piece : pieces_) piece->take_back();
  }

  /// Makes sure that there is room for `bytes` in one piece. A larger piece replaces one that nothing is taken of.
  void require(std::size_t bytes) {
    if (piece_with(bytes) != nullptr) return;
    const auto is_free = [](const auto& piece) { return piece->is_free(); };
    const auto spare = std::find_if(pieces_.begin(), pieces_.end(), is_free);
    if (spare != pieces_.end()) pieces_.erase(spare);
    pieces_.push_back(std::make_unique<SharedPages>(bytes));
  }

  /// An array of `count` values.
  template <class Value>
  Value* take(std::size_t count) {
    const std::size_t bytes = SharedPages::room_for<Value>(count);
    require(bytes);
    return piece_with(bytes)->template take<Value>(count);
  }

  std::size_t memory_bytes() const noexcept {
    std::size_t bytes = 0;
    for (const auto& piece : pieces_) bytes += piece->size();
    return bytes;
  }

 private:
  SharedPages* piece_with(std::size_t room) const {
    for (const auto& piece : pieces_) {
      if (piece->has_room(room)) return piece.get();
    }
    return nullptr;
  }

  std::vector<std::unique_ptr<SharedPages>> pieces_;
};

}  // namespace facemap
