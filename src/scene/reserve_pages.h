#pragma once

#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace facemap {

/// Reserves room for `count` values. If it is large, the system is asked for huge pages, since an array that is
/// written from end to end spends less time in page faults then; nothing depends on its consent.
template <class Value>
void reserve_pages(std::vector<Value>& values, std::size_t count) {
  values.reserve(count);
#ifdef MADV_HUGEPAGE
  constexpr std::uintptr_t kPage = 4096;
  constexpr std::size_t kHugePage = std::size_t{1} << 21;
  if (values.capacity() * sizeof(Value) < kHugePage) return;
  const auto begin = reinterpret_cast<std::uintptr_t>(values.data()) & ~(kPage - 1);
  const auto end = reinterpret_cast<std::uintptr_t>(values.data() + values.capacity()) & ~(kPage - 1);
  ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

/// Resizes a vector without values to `count` of them, all of which will be kept: their pages are had at once.
template <class Value>
void resize_pages(std::vector<Value>& values, std::size_t count) {
  // An array of which `malloc` makes a mapping of whole huge pages begins at one.
  constexpr std::size_t kHugePage = std::size_t{1} << 21, kHeader = 4096;
  const std::size_t bytes = count * sizeof(Value);
  if (bytes >= kHugePage) {
    values.reserve(((bytes + kHeader + kHugePage - 1) / kHugePage * kHugePage - kHeader) / sizeof(Value));
#ifdef MADV_POPULATE_WRITE
    constexpr std::uintptr_t kPage = 4096;
    const auto begin = reinterpret_cast<std::uintptr_t>(values.data()) & ~(kPage - 1);
    const auto last = reinterpret_cast<std::uintptr_t>(values.data() + count) & ~(kPage - 1);
    const auto huge_end = reinterpret_cast<std::uintptr_t>(values.data() + count) & ~(kHugePage - 1);
    ::madvise(reinterpret_cast<void*>(begin), huge_end - begin, MADV_HUGEPAGE);
    ::madvise(reinterpret_cast<void*>(begin), last - begin, MADV_POPULATE_WRITE);
#endif
  }
  values.resize(count);
}

}  // namespace facemap
