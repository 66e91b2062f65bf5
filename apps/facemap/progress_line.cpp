#include "progress_line.h"

#include <unistd.h>

#include <cmath>
#include <cstdio>

#include "report.h"

namespace facemap::program {
namespace {

constexpr auto kPause = std::chrono::milliseconds(100);  // a line that changes faster cannot be read
constexpr auto kJsonPause = std::chrono::seconds(1);
constexpr double kLeastSeconds = 1;  ///< of work, before the rest is foretold from it
constexpr double kLeastFraction = 0.02;

double seconds_of(std::chrono::steady_clock::duration time) { return std::chrono::duration<double>(time).count(); }

}  // namespace

ProgressLine::ProgressLine(std::size_t count)
    : count_(count),
      as_json_(report_style().json && !report_style().quiet),
      on_terminal_(!as_json_ && !report_style().quiet && ::isatty(STDERR_FILENO)) {}

ProgressLine::~ProgressLine() { clear(); }

/// From the pictures that are done, or of one picture from the phase alone; below 0: nobody knows yet.
double ProgressLine::seconds_left(double fraction, std::size_t frame, Clock::time_point now) const {
  const double done = count_ > 1 ? static_cast<double>(frame) / static_cast<double>(count_) : fraction;
  const double spent = seconds_of(now - (count_ > 1 ? begin_ : phase_begin_));
  if (spent < kLeastSeconds || done < kLeastFraction) return -1;
  return spent * (1 - done) / done;
}

void ProgressLine::show(double fraction, const char* phase, std::size_t frame) {
  if (!on_terminal_ && !as_json_) return;
  const Clock::time_point now = Clock::now();
  const std::string name = count_ == 1 ? phase : std::to_string(frame + 1) + "/" + std::to_string(count_) + " " + phase;
  if (name != phase_) phase_begin_ = now;
  phase_ = name;
  if (is_shown_ && now < next_) return;
  is_shown_ = true;
  const double left = seconds_left(fraction, frame, now);
  if (as_json_) {
    next_ = now + kJsonPause;
    say_progress(name, fraction, left);
    return;
  }
  next_ = now + kPause;
  const std::string rest = left < 0 ? "" : ", " + duration_text(left) + " left";
  std::fprintf(stderr, "\r\033[K%-12s %3.0f %%%s", name.c_str(), fraction * 100, rest.c_str());
  std::fflush(stderr);
}

void ProgressLine::clear() {
  if (!is_shown_ || !on_terminal_) return;
  std::fputs("\r\033[K", stderr);
  std::fflush(stderr);
  is_shown_ = false;
}

std::string duration_text(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(seconds));
  if (whole < 60) return std::to_string(whole) + " s";
  if (whole < 3600) return std::to_string(whole / 60) + " min " + std::to_string(whole % 60) + " s";
  return std::to_string(whole / 3600) + " h " + std::to_string(whole % 3600 / 60) + " min";
}

}  // namespace facemap::program
