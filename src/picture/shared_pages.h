#pragma once

#include <cstddef>
#include <functional>

#include "picture/pages.h"

namespace facemap {

/// Memory that several arrays share one after the other, so that large ones fill huge pages together. None is given
/// back before the last of them is gone. Not for several threads at a time.
class SharedPages {
 public:
  /// Of that many bytes, all zero.
  explicit SharedPages(std::size_t bytes) : pages_(bytes), size_(bytes) {}

  /// Room for an array of `count` values, or null if there is not enough left.
  template <class Value>
  Value* take(std::size_t count) {
    const std::size_t bytes = room_for<Value>(count);
    if (bytes > size_ - taken_) return nullptr;
    taken_ += bytes;
    return reinterpret_cast<Value*>(pages_.data() + (taken_ - bytes));
  }

  /// Takes all back, whose arrays must not be used any more. What stood there stays.
  void take_back() { taken_ = 0; }

  std::size_t size() const noexcept { return size_; }
  bool is_free() const noexcept { return taken_ == 0; }

  /// Gives the pages that are not taken back to the system.
  void give_back_rest() {
    pages_.give_back_from(taken_);
    size_ = taken_;
  }

  bool has_room(std::size_t bytes) const { return bytes <= size_ - taken_; }
  bool holds(const void* place) const {
    return std::less_equal<>()(static_cast<const void*>(pages_.data()), place) &&
           std::less<>()(place, static_cast<const void*>(pages_.data() + size_));
  }

  /// What an array of `count` values takes, in bytes.
  template <class Value>
  static constexpr std::size_t room_for(std::size_t count) {
    return (count * sizeof(Value) + kAlignment - 1) / kAlignment * kAlignment;
  }

 private:
  static constexpr std::size_t kAlignment = 64;

  Pages<char> pages_;
  std::size_t size_, taken_ = 0;
};

}  // namespace facemap
