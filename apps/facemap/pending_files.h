#pragma once

#include <facemap/atomic_file.h>

#include <cstdint>
#include <filesystem>
#include <list>
#include <optional>
#include <span>

#include "interrupt.h"

namespace facemap::program {

/// Files that appear together: each is written under a temporary name as it comes, and commit() puts all in place. What
/// was not committed is removed, by a signal, too. Standard output and what is no regular file is written to at once.
class PendingFiles {
 public:
  PendingFiles() = default;
  PendingFiles(const PendingFiles&) = delete;
  PendingFiles& operator=(const PendingFiles&) = delete;

  /// The whole of a file. Throws Error, as does commit().
  void add(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);
  void commit();

 private:
  struct Pending {
    explicit Pending(const std::filesystem::path& path);

    std::optional<RemovedOnSignal> removed;  // lives longer than the file
    AtomicFile file;
  };

  std::list<Pending> files_;
};

/// One file. Throws Error.
void write_output(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

}  // namespace facemap::program
