#include "progress_line.h"

#include <unistd.h>

#include <cstdio>

namespace facemap::program {

namespace {

constexpr auto kPause = std::chrono::milliseconds(100);  // a line that changes faster cannot be read

}  // namespace

ProgressLine::ProgressLine(bool wanted) : on_terminal_(wanted && ::isatty(STDERR_FILENO)) {}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::show(double fraction, const char* phase) {
  if (!on_terminal_) return;
  const Clock::time_point now = Clock::now();
  if (is_shown_ && now < next_) return;
  next_ = now + kPause;
  is_shown_ = true;
  std::fprintf(stderr, "\r\033[K%-12s %3.0f %%", phase, fraction * 100);
  std::fflush(stderr);
}

void ProgressLine::clear() {
  if (!is_shown_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  is_shown_ = false;
}

}  // namespace facemap::program
