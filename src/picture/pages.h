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
    const std::size_t bytes = (std::max<std::size_t>(1, count * sizeof(Value)) + kPage - 1) / kPage * kPage;
    const std::size_t room = bytes < kHugePage ? bytes : bytes + kHugePage;  // to begin at a huge page
    void* const start = ::mmap(nullptr, room, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (start == MAP_FAILED) throw std::bad_alloc();
    char* begin = static_cast<char*>(start);
    if (bytes >= kHugePage) begin += (kHugePage - reinterpret_cast<std::uintptr_t>(begin) % kHugePage) % kHugePage;
    const auto before = static_cast<std::size_t>(begin - static_cast<char*>(start));
    unmap(start, before);
    unmap(begin + bytes, room - before - bytes);
    mapped_ = bytes;
    const std::size_t on_huge_pages = bytes / kHugePage * kHugePage;
#ifdef MADV_HUGEPAGE
    if (on_huge_pages > 0) ::madvise(begin, on_huge_pages, MADV_HUGEPAGE);
#endif
#ifdef MADV_POPULATE_WRITE
    ::madvise(begin + on_huge_pages, bytes - on_huge_pages, MADV_POPULATE_WRITE);
#endif
    data_ = reinterpret_cast<Value*>(begin);
  }
  ~Pages() { unmap(data_, mapped_); }
  Pages(const Pages&) = delete;
  Pages& operator=(const Pages&) = delete;

  Value* data() const noexcept { return data_; }

  /// Gives the memory of the values from number `first` on back to the system, whole pages of it.
  void give_back_from(std::size_t first) {
    const std::size_t kept = (first * sizeof(Value) + kPage - 1) / kPage * kPage;
    if (kept >= mapped_) return;
    unmap(reinterpret_cast<char*>(data_) + kept, mapped_ - kept);
    mapped_ = kept;
  }

 private:
  static constexpr std::size_t kPage = 4096, kHugePage = std::size_t{1} << 21;

  static void unmap(void* begin, std::size_t bytes) noexcept {
    if (bytes > 0) ::munmap(begin, bytes);
  }

  std::size_t mapped_;  // bytes
  Value* data_;
};

}  // namespace facemap
