#pragma once

#include <chrono>
#include <string>

namespace facemap::program {

/// One line on a terminal that says how far the work is and how long it will take; nothing where standard error is a
/// file or a pipe, unless messages are JSON: then an object each second.
class ProgressLine {
 public:
  /// `count` pictures will be made.
  explicit ProgressLine(std::size_t count);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// `fraction` (0..1) of the phase of this name is done, of picture `frame`.
  void show(double fraction, const char* phase, std::size_t frame);

  /// Takes the line away, so that other text can follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;

  double seconds_left(double fraction, std::size_t frame, Clock::time_point now) const;

  std::size_t count_;
  bool as_json_, on_terminal_;
  bool is_shown_ = false;
  std::string phase_;
  Clock::time_point begin_ = Clock::now(), phase_begin_ = begin_, next_ = begin_;
};

/// "8 s", "2 min 5 s", "1 h 3 min".
std::string duration_text(double seconds);

}  // namespace facemap::program
