#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace facemap {

/// A file that appears whole or not at all: bytes go to a new file in the same folder, which commit() renames.
/// An old file of that name stays as it was until then, and its permissions are kept. A path that names
/// something else than a regular file (a pipe, a terminal, /dev/null) is written to directly; a symbolic link
/// stays a link. All members throw Error "path: what failed: reason".
class AtomicFile {
 public:
  explicit AtomicFile(const std::filesystem::path& path);
  ~AtomicFile();  ///< removes what was not committed
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  void write(const void* bytes, std::size_t size);

  /// Nothing more will be written: what a disk says only now is thrown here, and commit() has nothing to do but rename.
  void finish();
  void commit();

  /// The file that commit() renames; empty if there is none, or no more.
  const std::filesystem::path& temporary() const noexcept { return temporary_; }

 private:
  void open_beside();
  [[noreturn]] void fail(const std::string& doing, int error_number) const;

  std::filesystem::path path_;       ///< as given, for messages
  std::filesystem::path target_;     ///< links followed
  std::filesystem::path temporary_;  ///< empty when the target is written to directly
  int descriptor_ = -1;
};

/// Writes `size` bytes as the whole file. Throws Error.
void write_whole_file(const std::filesystem::path& path, const void* bytes, std::size_t size);

}  // namespace facemap
