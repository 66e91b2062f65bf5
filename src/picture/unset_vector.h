#pragma once

#include <cstddef>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "picture/shared_pages.h"

namespace facemap {

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
