#pragma once

#include <cstddef>
#include <vector>

namespace facemap {

/// What a vector's elements take, with the room that is kept for more.
template <class Value, class Allocator>
std::size_t bytes_of(const std::vector<Value, Allocator>& values) {
  return values.capacity() * sizeof(Value);
}

}  // namespace facemap
