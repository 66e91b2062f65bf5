#pragma once

#include <filesystem>
#include <functional>

namespace facemap::program {

/// SIGINT, SIGTERM and SIGHUP from here on: they end the program at once, with exit code 128 + signal, or after the
/// write_whole that is under way. A limit on file sizes becomes an ordinary error.
void catch_signals();

/// Runs `write`, which puts files in place whole or not at all; a signal that comes meanwhile waits until it is done,
/// and then ends the program. A second signal does not wait. For one thread at a time.
void write_whole(const std::function<void()>& write);

/// While it lives, a signal removes this file before the program ends.
class RemovedOnSignal {
 public:
  /// Throws Error if the name is too long.
  explicit RemovedOnSignal(const std::filesystem::path& path);
  ~RemovedOnSignal();
  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal& operator=(const RemovedOnSignal&) = delete;
};

}  // namespace facemap::program
