#pragma once

#include <cstddef>
#include <cstdint>

#include "picture/working_memory.h"
#include "simd/listed_points.h"

namespace facemap {

/// What a list of `count` points takes.
inline std::size_t bytes_of_list(std::size_t count) {
  return 4 * SharedPages::room_for<std::int32_t>(count + simd::kListPadding);
}

/// An empty list with room for `count` points.
inline simd::ListedPoints list_in(WorkingMemory &memory, std::size_t count) {
  const std::size_t room = count + simd::kListPadding;
  const auto take = [&] { return memory.take<std::int32_t>(room); };
  std::int32_t *const x = take(), *const y = take(), *const z = take();
  return {x, y, z, memory.take<std::uint32_t>(room), 0};
}

}  // namespace facemap
