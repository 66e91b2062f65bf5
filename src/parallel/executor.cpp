#include "parallel/executor.h"

#if FACEMAP_HAS_TBB
#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>
#else
#include "parallel/thread_pool.h"
#endif

#include <algorithm>
#include <atomic>
#include <map>
#include <memory>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#if defined(__linux__)
#include <pthread.h>
#include <sched.h>
#endif

#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

int available_threads() {
#if defined(__linux__)
  cpu_set_t processors;
  if (::sched_getaffinity(0, sizeof processors, &processors) == 0) return std::max(1, CPU_COUNT(&processors));
#endif
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// fork() copies none of the threads that wait for work: a child of a process that had some does its tasks by itself.
std::atomic<bool> has_lost_threads = false;

void notice_forks() {
#if defined(__linux__)
  [[maybe_unused]] static const int failed = ::pthread_atfork(nullptr, nullptr, [] { has_lost_threads = true; });
#endif
}

#if FACEMAP_HAS_TBB

/// Lets oneTBB start more threads than there are processors, if somebody asks for so many; it would print a warning
/// and start fewer. Of several limits the lowest holds: the new one replaces the old one, and the last one stays.
void allow_threads(int threads) {
  static std::mutex mutex;
  static tbb::global_control* limit = nullptr;
  static int allowed = available_threads();
  const std::lock_guard lock(mutex);
  if (threads <= allowed) return;
  delete limit;
  limit = new tbb::global_control(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  allowed = threads;
}

/// Arenas that nobody uses, for the next who wants so many threads: Debian's oneTBB (2021.8) keeps some kilobytes of
/// each arena that has ended, so that a process that makes many would grow.
class SpareArenas {
 public:
  static SpareArenas& all() {
    static SpareArenas& arenas = *new SpareArenas;  // for ever: executors may outlive static objects
    return arenas;
  }

  std::unique_ptr<tbb::task_arena> take(int threads) {
    const std::lock_guard lock(mutex_);
    auto& spare = of_threads_[threads];
    if (spare.empty()) return std::make_unique<tbb::task_arena>(threads);
    std::unique_ptr<tbb::task_arena> arena = std::move(spare.back());
    spare.pop_back();
    return arena;
  }

  void give_back(int threads, std::unique_ptr<tbb::task_arena> arena) {
    const std::lock_guard lock(mutex_);
    of_threads_[threads].push_back(std::move(arena));
  }

 private:
  std::mutex mutex_;
  std::map<int, std::vector<std::unique_ptr<tbb::task_arena>>> of_threads_;
};

#endif

}  // namespace

#if FACEMAP_HAS_TBB

class Executor::Pool {
 public:
  explicit Pool(int threads) : threads_(threads), arena_(SpareArenas::all().take(threads)) { allow_threads(threads); }
  ~Pool() { SpareArenas::all().give_back(threads_, std::move(arena_)); }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  void for_each(std::size_t count, const Task& task) {
    // Isolated, so that a task that waits for its own call does not begin another task of the outer one, whose worker
    // would be the same.
    arena_->execute([&] { tbb::this_task_arena::isolate([&] { run(count, task); }); });
  }

 private:
  static void run(std::size_t count, const Task& task) {
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          const FloatingPointMode mode;
          for (std::size_t i = range.begin(); i != range.end(); ++i) {
            task(i, tbb::this_task_arena::current_thread_index());
          }
        },
        tbb::simple_partitioner());
  }

  int threads_;
  std::unique_ptr<tbb::task_arena> arena_;
};

#else

class Executor::Pool : public ThreadPool {
  using ThreadPool::ThreadPool;
};

#endif

Executor::Executor(int threads) : threads_(threads > 0 ? threads : available_threads()) {
  if (threads_ == 1) return;
  notice_forks();
  if (!has_lost_threads) pool_ = std::make_unique<Pool>(threads_);
}

Executor::~Executor() {
  if (has_lost_threads) static_cast<void>(pool_.release());  // it would wait for its threads
}

void Executor::for_each(std::size_t count, const Task& task) const {
  if (count == 0) return;
  if (pool_ != nullptr && !has_lost_threads)
    return pool_->for_each(count, task);  // one task, too: its worker may not be 0
  const FloatingPointMode mode;
  for (std::size_t i = 0; i < count; ++i) task(i, 0);
}

void for_ranges(const Executor& executor, std::size_t count, std::size_t least,
                const std::function<void(std::size_t, std::size_t, int)>& body) {
  if (count == 0) return;
  const std::size_t most_pieces = executor.threads() == 1 ? 1 : 4 * static_cast<std::size_t>(executor.threads());
  const std::size_t pieces = std::clamp<std::size_t>(count / std::max<std::size_t>(1, least), 1, most_pieces);
  executor.for_each(pieces, [&](std::size_t i, int worker) {
    body(count / pieces * i + std::min(i, count % pieces), count / pieces * (i + 1) + std::min(i + 1, count % pieces),
         worker);
  });
}

}  // namespace facemap
