#include "facemap_bench_memory.h"

#include <malloc.h>
#include <sys/mman.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstddef>

// These stand before the C library's own of the same names, which go on under their inner names.
extern "C" {
void* __libc_malloc(std::size_t);
void* __libc_calloc(std::size_t, std::size_t);
void* __libc_realloc(void*, std::size_t);
void* __libc_memalign(std::size_t, std::size_t);
void __libc_free(void*);
}

namespace facemap::bench {
namespace {

std::atomic<bool> counting{false};
std::atomic<std::int64_t> held{0}, peak{0};

void add(std::int64_t bytes) {
  const std::int64_t now = held.fetch_add(bytes, std::memory_order_relaxed) + bytes;
  std::int64_t before = peak.load(std::memory_order_relaxed);
  while (now > before && !peak.compare_exchange_weak(before, now, std::memory_order_relaxed)) {
  }
}

bool is_counting() { return counting.load(std::memory_order_relaxed); }

void* taken(void* block) {
  if (block && is_counting()) add(static_cast<std::int64_t>(malloc_usable_size(block)));
  return block;
}

void given_back(void* block) {
  if (block && is_counting()) add(-static_cast<std::int64_t>(malloc_usable_size(block)));
}

}  // namespace

void MemoryMeter::start() {
  held = peak = 0;
  counting = true;
}

void MemoryMeter::forget_peak() { peak = held.load(); }

std::int64_t MemoryMeter::stop() {
  counting = false;
  return peak;
}

}  // namespace facemap::bench

using facemap::bench::add;
using facemap::bench::given_back;
using facemap::bench::is_counting;
using facemap::bench::taken;

extern "C" {

void* malloc(std::size_t size) { return taken(__libc_malloc(size)); }
void* calloc(std::size_t count, std::size_t size) { return taken(__libc_calloc(count, size)); }
void* memalign(std::size_t alignment, std::size_t size) { return taken(__libc_memalign(alignment, size)); }
void* aligned_alloc(std::size_t alignment, std::size_t size) { return taken(__libc_memalign(alignment, size)); }

int posix_memalign(void** block, std::size_t alignment, std::size_t size) {
  *block = taken(__libc_memalign(alignment, size));
  return *block ? 0 : ENOMEM;
}

void* realloc(void* block, std::size_t size) {
  given_back(block);
  return taken(__libc_realloc(block, size));
}

void free(void* block) {
  given_back(block);
  __libc_free(block);
}

void* mmap(void* address, std::size_t length, int protection, int flags, int file, off_t offset) noexcept {
  void* const pages = reinterpret_cast<void*>(::syscall(SYS_mmap, address, length, protection, flags, file, offset));
  if (pages != MAP_FAILED && (flags & MAP_ANONYMOUS) && is_counting()) add(static_cast<std::int64_t>(length));
  return pages;
}

// Of mappings, those of files are given back too: none is made while memory is counted.
int munmap(void* address, std::size_t length) noexcept {
  if (is_counting()) add(-static_cast<std::int64_t>(length));
  return static_cast<int>(::syscall(SYS_munmap, address, length));
}

}  // extern "C"
