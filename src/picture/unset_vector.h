#pragma once

#include <memory>
#include <new>
#include <vector>

namespace facemap {

/// std::allocator, but elements that are added without a value are left as they are.
template <class Value>
struct UnsetAllocator : std::allocator<Value> {
  template <class Other>
  struct rebind {
    using other = UnsetAllocator<Other>;
  };

  UnsetAllocator() = default;
  template <class Other>
  UnsetAllocator(const UnsetAllocator<Other>&) noexcept {}

  template <class Element>
  void construct(Element* element) noexcept {
    ::new (static_cast<void*>(element)) Element;
  }
};

/// A vector of plain numbers whose resize() leaves new ones without a value: they are written before they are read, by
/// several threads maybe, which then share the work of touching fresh memory.
template <class Value>
using UnsetVector = std::vector<Value, UnsetAllocator<Value>>;

}  // namespace facemap
