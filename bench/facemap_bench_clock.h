#pragma once

#include <ctime>

namespace facemap::bench {

/// Whose time is measured: the wall clock's, or what the process or the calling thread has computed, which for one
/// thread says the same on an idle machine and goes on meaning it on a busy one.
enum class Time { Wall, Process, Thread };

/// Milliseconds since it was made.
class Stopwatch {
 public:
  explicit Stopwatch(Time time)
      : clock_(time == Time::Wall      ? CLOCK_MONOTONIC
               : time == Time::Process ? CLOCK_PROCESS_CPUTIME_ID
                                       : CLOCK_THREAD_CPUTIME_ID),
        start_(now()) {}
  double milliseconds() const { return now() - start_; }

 private:
  double now() const {
    std::timespec time;
    clock_gettime(clock_, &time);
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_nsec);
  }

  clockid_t clock_;
  double start_;
};

}  // namespace facemap::bench
