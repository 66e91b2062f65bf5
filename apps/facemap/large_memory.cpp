// The program's operator new: memory lies on huge pages where the system has any. A run touches tens of megabytes once,
// and asking for each page of 4 KiB apart would take a tenth of its time. Under sanitizers theirs stays.

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace {

constexpr std::size_t kHugePage = std::size_t{1} << 21;

#if defined(__GLIBC__) && defined(MADV_HUGEPAGE)

// The heap grows by so much at a time. It is address space: what is not touched takes no memory.
constexpr int kHeapStep = 1 << 26;

// Blocks from this size on are mapped and unmapped one by one: the most that malloc takes for it.
constexpr std::size_t kMappedBlock = std::size_t{1} << 25;

// One heap for all threads, which keeps what is given back: memory that is used again need not be cleared again.
const bool has_heap = [] {
  return ::mallopt(M_ARENA_MAX, 1) == 1 && ::mallopt(M_TOP_PAD, kHeapStep) == 1 &&
         ::mallopt(M_TRIM_THRESHOLD, kHeapStep) == 1 &&
         ::mallopt(M_MMAP_THRESHOLD, static_cast<int>(kMappedBlock)) == 1;
}();

// Where the heap ended when huge pages were asked for last.
std::atomic<std::uintptr_t> advised_end{0};

// Asks for them for what the heap has grown by since, if `block` lies there.
void advise_heap(const void* block) noexcept {
  constexpr std::uintptr_t kPage = 4096;
  const auto at = reinterpret_cast<std::uintptr_t>(block) / kPage * kPage;
  std::uintptr_t begin = advised_end.load(std::memory_order_relaxed);
  if (at < begin) return;
  const auto end = reinterpret_cast<std::uintptr_t>(::sbrk(0));
  if (at >= end || !advised_end.compare_exchange_strong(begin, end)) return;  // not of the heap, or told by another
  if (begin == 0) begin = at;
  ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
}

#else

constexpr std::size_t kMappedBlock = kHugePage;

void advise_heap(const void*) noexcept {}

#endif

void* allocate_small(std::size_t size, std::size_t alignment) noexcept {
  if (alignment <= __STDCPP_DEFAULT_NEW_ALIGNMENT__) return std::malloc(std::max<std::size_t>(size, 1));
  return std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
}

void* allocate(std::size_t size, std::size_t alignment) noexcept {
  if (size < kMappedBlock) {
    void* const block = allocate_small(size, alignment);
    if (block != nullptr) advise_heap(block);
    return block;
  }
  void* const block = std::aligned_alloc(std::max(alignment, kHugePage), size);
#ifdef MADV_HUGEPAGE
  // Whole huge pages alone, so that no more memory is taken than was asked for.
  if (block != nullptr) ::madvise(block, size / kHugePage * kHugePage, MADV_HUGEPAGE);
#endif
  return block;
}

void* allocate_or_throw(std::size_t size, std::size_t alignment) {
  while (true) {
    if (void* const block = allocate(size, alignment)) return block;
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
  }
}

}  // namespace

// The other forms call these two, and std::free takes back what any of them gave.
void* operator new(std::size_t size) { return allocate_or_throw(size, __STDCPP_DEFAULT_NEW_ALIGNMENT__); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  return allocate_or_throw(size, static_cast<std::size_t>(alignment));
}
void operator delete(void* block) noexcept { std::free(block); }
void operator delete(void* block, std::size_t) noexcept { std::free(block); }
void operator delete(void* block, std::align_val_t) noexcept { std::free(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { std::free(block); }

#endif
