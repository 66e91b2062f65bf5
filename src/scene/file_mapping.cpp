#include "scene/file_mapping.h"

#include <facemap/error.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdint>
#include <system_error>

namespace facemap {

namespace {

[[noreturn]] void fail_open(const std::string& name, int error) {
  throw LoadError(LoadError::Cause::CannotOpen, name, 0, std::generic_category().message(error));
}

[[noreturn]] void fail_large(const std::string& name, std::uint64_t max_bytes) {
  throw LoadError(LoadError::Cause::TooLarge, name, 0, "more than " + std::to_string(max_bytes) + " bytes");
}

/// Closes a file descriptor at the end of its scope.
struct Descriptor {
  int number;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

}  // namespace

FileMapping::FileMapping(const std::filesystem::path& path, std::uint64_t max_bytes) {
  const std::string name = path.string();
  const Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.number < 0) fail_open(name, errno);
  struct stat status {};
  if (::fstat(file.number, &status) != 0) fail_open(name, errno);
  if (S_ISDIR(status.st_mode)) fail_open(name, EISDIR);
  if (S_ISREG(status.st_mode)) {
    const auto size = static_cast<std::uint64_t>(status.st_size);
    if (size > max_bytes) fail_large(name, max_bytes);
    map(file.number, size, name);
  } else {
    read(file.number, max_bytes, name);
  }
}

FileMapping::~FileMapping() {
  if (mapped_ != nullptr) ::munmap(mapped_, text_.size());
}

void FileMapping::release(std::string_view part) const noexcept {
  constexpr std::uintptr_t kPage = 4096;
  const auto begin = (reinterpret_cast<std::uintptr_t>(part.data()) + kPage - 1) / kPage * kPage;
  const auto end = reinterpret_cast<std::uintptr_t>(part.data() + part.size()) / kPage * kPage;
  // Pages of a file come back from there when they are touched; refusal does no harm.
  if (mapped_ != nullptr && begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_DONTNEED);
}

void FileMapping::map(int descriptor, std::uint64_t size, const std::string& name) {
  if (size == 0) return;  // mmap refuses an empty file
  void* const bytes = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor, 0);
  if (bytes == MAP_FAILED) fail_open(name, errno);
  ::madvise(bytes, size, MADV_SEQUENTIAL);
  mapped_ = bytes;
  text_ = std::string_view(static_cast<const char*>(bytes), size);
}

void FileMapping::read(int descriptor, std::uint64_t max_bytes, const std::string& name) {
  constexpr std::size_t kStep = std::size_t{1} << 16;
  while (true) {
    const std::size_t size = read_.size();
    read_.resize(size + kStep);
    const ssize_t got = ::read(descriptor, read_.data() + size, kStep);
    if (got < 0 && errno != EINTR) fail_open(name, errno);
    read_.resize(size + static_cast<std::size_t>(got > 0 ? got : 0));
    if (read_.size() > max_bytes) fail_large(name, max_bytes);
    if (got == 0) break;
  }
  text_ = read_;
}

}  // namespace facemap
