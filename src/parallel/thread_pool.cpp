#include "parallel/thread_pool.h"

#include <atomic>
#include <exception>

#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

/// The pool whose task this thread runs, and as which worker.
struct Place {
  const ThreadPool* pool = nullptr;
  int worker = 0;
};
thread_local Place place;

/// This thread's place for its lifetime; then the old one again.
class InPlace {
 public:
  explicit InPlace(Place here) : old_(place) { place = here; }
  ~InPlace() { place = old_; }
  InPlace(const InPlace&) = delete;
  InPlace& operator=(const InPlace&) = delete;

 private:
  Place old_;
};

}  // namespace

/// One call of for_each, on the stack of its caller.
struct ThreadPool::Job {
  Job(std::size_t task_count, const Task& each) : count(task_count), task(&each) {}

  const std::size_t count;
  const Task* const task;
  std::atomic<std::size_t> next{0};
  int helpers = 0;             ///< threads at work on it beside its caller; guarded by mutex_, as the next
  std::exception_ptr failure;  ///< the first
};

ThreadPool::ThreadPool(int threads) {
  for (int worker = 1; worker < threads; ++worker) {
    threads_.emplace_back([this, worker] { serve(worker); });
  }
}

ThreadPool::~ThreadPool() {
  {
    const std::lock_guard lock(mutex_);
    is_ending_ = true;
  }
  has_work_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

void ThreadPool::for_each(std::size_t count, const Task& task) {
  if (count == 0) return;
  Job job(count, task);
  if (place.pool == this) {
    run(job, place.worker);
  } else {
    const std::lock_guard turn(turn_);
    const InPlace here({this, 0});
    run(job, 0);
  }
  if (job.failure) std::rethrow_exception(job.failure);
}

void ThreadPool::run(Job& job, int worker) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(&job);
  }
  has_work_.notify_all();
  work_on(job, worker);
  // Those still at work on it wait for no more than calls of their own, so that this ends.
  std::unique_lock lock(mutex_);
  has_finished_.wait(lock, [&] { return job.helpers == 0; });
}

/// Runs tasks until none is left, and takes the job off the list.
void ThreadPool::work_on(Job& job, int worker) {
  const FloatingPointMode mode;
  for (std::size_t i = 0; (i = job.next.fetch_add(1, std::memory_order_relaxed)) < job.count;) {
    try {
      (*job.task)(i, worker);
    } catch (...) {
      const std::lock_guard lock(mutex_);
      if (!job.failure) job.failure = std::current_exception();
      job.next = job.count;
    }
  }
  const std::lock_guard lock(mutex_);
  std::erase(jobs_, &job);
}

void ThreadPool::serve(int worker) {
  const InPlace here({this, worker});
  std::unique_lock lock(mutex_);
  while (true) {
    has_work_.wait(lock, [this] { return is_ending_ || !jobs_.empty(); });
    if (is_ending_) return;
    Job& job = *jobs_.back();  // calls of tasks come last, and others wait for them
    ++job.helpers;
    lock.unlock();
    work_on(job, worker);
    lock.lock();
    if (--job.helpers == 0) has_finished_.notify_all();
  }
}

}  // namespace facemap
