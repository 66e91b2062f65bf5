#include <facemap/atomic_file.h>
#include <facemap/error.h>
#include <facemap/image_file.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace facemap {
namespace {

constexpr int kNameAttempts = 100;
constexpr std::size_t kMostNameBytes = 200;  // of a temporary's name: with what is added it still is a name

}  // namespace

AtomicFile::AtomicFile(const std::filesystem::path& path) : path_(path), target_(path) {
  struct stat old {};
  if (::stat(path.c_str(), &old) != 0) {
    open_beside();
    return;
  }
  if (S_ISDIR(old.st_mode)) fail("cannot write", EISDIR);
  if (!S_ISREG(old.st_mode)) {
    descriptor_ = ::open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail("cannot open", errno);
    return;
  }
  std::error_code error;
  target_ = std::filesystem::canonical(path, error);
  if (error) fail("cannot find", error.value());
  open_beside();
  // Best effort: on some file systems modes cannot be changed, which harms nothing.
  if (::fchmod(descriptor_, old.st_mode & 07777) != 0) errno = 0;
}

AtomicFile::~AtomicFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
  if (!temporary_.empty()) ::unlink(temporary_.c_str());
}

void AtomicFile::open_beside() {
  for (int attempt = 0; attempt < kNameAttempts; ++attempt) {
    std::string name = ".";
    name += target_.filename().string().substr(0, kMostNameBytes) + "." + std::to_string(::getpid()) + "-" +
            std::to_string(attempt) + ".tmp";
    const std::filesystem::path candidate = target_.parent_path() / name;
    descriptor_ = ::open(candidate.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor_ >= 0) {
      temporary_ = candidate;
      return;
    }
    if (errno != EEXIST) break;
  }
  fail("cannot write in its folder", errno);
}

void AtomicFile::write(const void* bytes, std::size_t size) {
  const char* next = static_cast<const char*>(bytes);
  while (size > 0) {
    const ::ssize_t written = ::write(descriptor_, next, size);
    if (written < 0) {
      if (errno == EINTR) continue;
      fail("cannot write", errno);
    }
    next += written;
    size -= static_cast<std::size_t>(written);
  }
}

void AtomicFile::finish() {
  if (descriptor_ < 0) return;
  const int descriptor = descriptor_;
  descriptor_ = -1;
  // Some file systems report a full disk only when a file is closed.
  if (::close(descriptor) != 0 && errno != EINTR) fail("cannot write", errno);
}

void AtomicFile::commit() {
  finish();
  if (temporary_.empty()) return;
  if (::rename(temporary_.c_str(), target_.c_str()) != 0) fail("cannot rename the finished file", errno);
  temporary_.clear();
}

void AtomicFile::fail(const std::string& doing, int error_number) const {
  throw Error(path_.string() + ": " + doing + ": " + std::generic_category().message(error_number));
}

void write_whole_file(const std::filesystem::path& path, const void* bytes, std::size_t size) {
  AtomicFile file(path);
  file.write(bytes, size);
  file.commit();
}

void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes) {
  write_whole_file(path, bytes.data(), bytes.size());
}

}  // namespace facemap
