#pragma once

#include <chrono>

namespace facemap::program {

/// One line on a terminal that says how far the work is; nothing where standard error is a file or a pipe.
class ProgressLine {
 public:
  explicit ProgressLine(bool wanted);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `fraction` (0..1) of the phase of this name is done.
  void show(double fraction, const char* phase);

  /// Takes the line away, so that other text can follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  bool on_terminal_;
  bool is_shown_ = false;
  Clock::time_point next_ = Clock::now();
};

}  // namespace facemap::program
