#pragma once

#include <filesystem>
#include <functional>

namespace facemap::program {

/// SIGINT, SIGTERM and SIGHUP from here on: nothing is written before the end, so until then they end the
/// program at once, with exit code 128 + signal. A limit on file sizes becomes an ordinary error.
void catch_signals();

/// Thrown by write_whole when a signal came meanwhile.
struct Interrupted {
  int signal;
};

/// Runs `write`, which puts files in place whole or not at all; a signal waits until it is done. A second
/// signal does not wait.
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
