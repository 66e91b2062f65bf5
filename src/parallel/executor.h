#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace facemap {

/// Runs numbered tasks on several threads: the one place of the library that starts any.
///
/// Which thread runs which task, and when, is open; tasks write to places of their own, so that results do not
/// depend on it. Each task runs in the default floating-point mode. Tasks may call for_each themselves. In a process
/// that was forked from one with an Executor of several threads, the calling thread runs all tasks.
class Executor {
 public:
  /// `threads` in all, the calling one included; 0: as many as the process may run at once.
  explicit Executor(int threads);
  ~Executor();
  Executor(const Executor&) = delete;
  Executor& operator=(const Executor&) = delete;

  int threads() const noexcept { return threads_; }

  /// Calls task(i, worker) for every i in 0..count-1 and returns when all are done. Two tasks that run at the same
  /// time have different workers, 0..threads()-1. Rethrows one of the exceptions that tasks threw, after which tasks
  /// that have not begun are left out.
  using Task = std::function<void(std::size_t index, int worker)>;
  void for_each(std::size_t count, const Task& task) const;

 private:
  class Pool;
  int threads_;
  std::unique_ptr<Pool> pool_;  ///< none for one thread
};

/// Calls body(first, last) for pieces of 0..count-1 of at least `least` elements (the last may be shorter), at most
/// four a thread.
void for_ranges(const Executor& executor, std::size_t count, std::size_t least,
                const std::function<void(std::size_t first, std::size_t last, int worker)>& body);

}  // namespace facemap
