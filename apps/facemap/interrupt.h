#pragma once

#include <filesystem>
#include <functional>

namespace facemap::program {

/// SIGINT, SIGTERM, SIGHUP, SIGPIPE and SIGXCPU from here on: they end the program at once, with exit code 128 +
/// signal, or after the hold_signals that is under way. A limit on file sizes becomes an ordinary error.
void catch_signals();

/// Runs `work`, which is short; a signal that comes meanwhile waits until it is done, and then ends the program. For
/// one thread at a time.
void hold_signals(const std::function<void()>& work);

/// While it lives, a signal removes this file before the program ends.
class RemovedOnSignal {
 public:
  /// Throws Error if the name is too long, or too many files are to be removed.
  explicit RemovedOnSignal(const std::filesystem::path& path);
  ~RemovedOnSignal();
  RemovedOnSignal(const RemovedOnSignal&) = delete;
  RemovedOnSignal& operator=(const RemovedOnSignal&) = delete;

 private:
  int slot_;
};

}  // namespace facemap::program
