#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>

namespace facemap {

/// Plain numbers, all zero to begin with, that begin at a multiple of 64 bytes. Fresh memory is mostly page faults: a
/// large array stands on huge pages where the system gives them, and a smaller one gets all its pages at once.
template <class Value>
class Pages {
 public:
  explicit Pages(std::size_t count) {
    const std::size_t bytes = std::max<std::size_t>(1, count * sizeof(Value));
    mapped_ = bytes < kHugePage ? bytes : bytes + kHugePage;  // room to begin at a huge page
    start_ = ::mmap(nullptr, mapped_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (start_ == MAP_FAILED) throw std::bad_alloc();
    char* begin = static_cast<char*>(start_);
    if (bytes >= kHugePage) begin += (kHugePage - reinterpret_cast<std::uintptr_t>(begin) % kHugePage) % kHugePage;
    const std::size_t on_huge_pages = bytes / kHugePage * kHugePage;
#ifdef MADV_HUGEPAGE
    if (on_huge_pages > 0) ::madvise(begin, on_huge_pages, MADV_HUGEPAGE);
#endif
#ifdef MADV_POPULATE_WRITE
    ::madvise(begin + on_huge_pages, bytes - on_huge_pages, MADV_POPULATE_WRITE);
#endif
    data_ = reinterpret_cast<Value*>(begin);
  }
  ~Pages() { ::munmap(start_, mapped_); }
  Pages(const Pages&) = delete;
  Pages& operator=(const Pages&) = delete;

  Value* data() const noexcept { return data_; }

  /// Lets the system have the memory of the values from number `first` on, which are 0 afterwards but for those of the
  /// page where the first stands.
  void give_back_from(std::size_t first) {
    constexpr std::uintptr_t kPage = 4096;
    const auto begin = (reinterpret_cast<std::uintptr_t>(data_ + first) + kPage - 1) / kPage * kPage;
    const auto end = reinterpret_cast<std::uintptr_t>(start_) + mapped_;
    if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED);
  }

 private:
  static constexpr std::size_t kHugePage = std::size_t{1} << 21;

  void* start_;
  std::size_t mapped_;
  Value* data_;
};

}  // namespace facemap
