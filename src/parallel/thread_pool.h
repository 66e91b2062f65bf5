#pragma once

#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace facemap {

/// Executor's work on threads of its own, for builds without oneTBB (the thread sanitizer takes the ways of Debian's
/// build of it for races) and as its measure in tests. Threads sleep while there is nothing to do.
class ThreadPool {
 public:
  /// `threads` in all, the calling one included: starts one less.
  explicit ThreadPool(int threads);
  ~ThreadPool();
  ThreadPool(const ThreadPool&) = delete;
  ThreadPool& operator=(const ThreadPool&) = delete;

  /// As Executor::for_each. Threads from outside take turns; a task's own calls do not wait for others'.
  using Task = std::function<void(std::size_t index, int worker)>;
  void for_each(std::size_t count, const Task& task);

 private:
  struct Job;

  void run(Job& job, int worker);
  void work_on(Job& job, int worker);
  void serve(int worker);

  std::mutex turn_;  ///< held by the thread from outside that is worker 0
  std::mutex mutex_;
  std::condition_variable has_work_, has_finished_;
  std::vector<Job*> jobs_;  ///< with tasks that have not begun; guarded by mutex_, as the next
  bool is_ending_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace facemap
