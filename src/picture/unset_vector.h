#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "picture/pages.h"

namespace facemap {

/// Memory that several arrays share one after the other, so that large ones fill huge pages together. None is given
/// back before the last of them is gone.
class SharedPages {
 public:
  explicit SharedPages(std::size_t bytes) : pages_(bytes), room_(bytes) {}

  /// Room for an array of `count` values, or null if there is not enough left.
  template <class Value>
  Value* take(std::size_t count) {
    const std::size_t bytes = room_for<Value>(count);
    if (bytes > room_ - taken_) return nullptr;
    taken_ += bytes;
    return reinterpret_cast<Value*>(pages_.data() + (taken_ - bytes));
  }
  bool holds(const void* place) const {
    return std::less_equal<>()(static_cast<const void*>(pages_.data()), place) &&
           std::less<>()(place, static_cast<const void*>(pages_.data() + room_));
  }

  /// What an array of `count` values takes, in bytes.
  template <class Value>
  static constexpr std::size_t room_for(std::size_t count) {
    return (count * sizeof(Value) + kAlignment - 1) / kAlignment * kAlignment;
  }

 private:
  static constexpr std::size_t kAlignment = 64;

  Pages<char> pages_;
  std::size_t room_, taken_ = 0;
};

/// As std::allocator, but elements that are added without a value are left as they are, and memory may be taken from
/// what is shared.
template <class Value>
class UnsetAllocator {
 public:
  using value_type = Value;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  UnsetAllocator() = default;
  explicit UnsetAllocator(std::shared_ptr<SharedPages> pages) : pages_(std::move(pages)) {}
  template <class Other>
  UnsetAllocator(const UnsetAllocator<Other>& other) noexcept : pages_(other.pages_) {}

  Value* allocate(std::size_t count) {
    Value* shared = pages_ ? pages_->template take<Value>(count) : nullptr;
    return shared != nullptr ? shared : std::allocator<Value>().allocate(count);
  }
  void deallocate(Value* values, std::size_t count) noexcept {
    if (!pages_ || !pages_->holds(values)) std::allocator<Value>().deallocate(values, count);
  }

  template <class Element>
  void construct(Element* element) noexcept {
    ::new (static_cast<void*>(element)) Element;
  }
  template <class Element, class... Arguments>
  void construct(Element* element, Arguments&&... arguments) {
    ::new (static_cast<void*>(element)) Element(std::forward<Arguments>(arguments)...);
  }

  template <class Other>
  bool operator==(const UnsetAllocator<Other>& other) const noexcept {
    return pages_ == other.pages_;
  }

  /// For copies of vectors: of their own.
  UnsetAllocator select_on_container_copy_construction() const { return {}; }

 private:
  template <class Other>
  friend class UnsetAllocator;

  std::shared_ptr<SharedPages> pages_;
};

/// A vector of plain numbers whose resize() leaves new ones without a value: they are written before they are read, by
/// several threads maybe, which then share the work of touching fresh memory.
template <class Value>
using UnsetVector = std::vector<Value, UnsetAllocator<Value>>;

}  // namespace facemap
