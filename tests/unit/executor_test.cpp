#include "parallel/executor.h"

#include <facemap/error.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <fstream>
#include <limits>
#include <memory>
#include <mutex>
#include <numeric>
#include <set>
#include <thread>
#include <vector>

#if defined(__SSE2__)
#include <immintrin.h>
#endif
#if defined(__linux__)
#include <sys/wait.h>
#include <unistd.h>
#endif

#include "parallel/thread_pool.h"

namespace facemap {
namespace {

/// An executor's members on the pool that builds without oneTBB use: both are tested in every build.
class PoolOnly {
 public:
  explicit PoolOnly(int threads) : threads_(threads), pool_(threads) {}
  int threads() const { return threads_; }
  void for_each(std::size_t count, const ThreadPool::Task& task) const { pool_.for_each(count, task); }

 private:
  int threads_;
  mutable ThreadPool pool_;
};

template <class Runner>
class ExecutorTest : public testing::Test {};
using Runners = testing::Types<Executor, PoolOnly>;
TYPED_TEST_SUITE(ExecutorTest, Runners);

TYPED_TEST(ExecutorTest, RunsEachTaskOnce) {
  for (const int threads : {1, 2, 3, 8}) {
    const TypeParam executor(threads);
    EXPECT_EQ(executor.threads(), threads);
    for (const std::size_t count : {0u, 1u, 2u, 7u, 1000u}) {
      std::vector<std::atomic<int>> runs(count);
      executor.for_each(count, [&](std::size_t i, int) { ++runs[i]; });
      for (const std::atomic<int>& times : runs) EXPECT_EQ(times, 1) << threads << " threads, " << count << " tasks";
    }
  }
}

TYPED_TEST(ExecutorTest, TasksAtTheSameTimeHaveDifferentWorkers) {
  constexpr int kThreads = 4;
  const TypeParam executor(kThreads);
  std::vector<std::atomic<bool>> is_busy(kThreads);
  std::atomic<int> clashes = 0;
  const auto occupy = [&](int worker) {
    ASSERT_TRUE(worker >= 0 && worker < kThreads);
    if (is_busy[worker].exchange(true)) ++clashes;
    std::this_thread::yield();
    is_busy[worker] = false;
  };
  executor.for_each(2000, [&](std::size_t, int worker) { occupy(worker); });
  EXPECT_EQ(clashes, 0);

  // Callers from outside share the workers, a single task included.
  std::vector<std::thread> callers;
  for (int i = 0; i < 3; ++i) {
    callers.emplace_back([&, i] {
      for (int round = 0; round < 50; ++round) {
        executor.for_each(i == 0 ? 1 : 20, [&](std::size_t, int worker) { occupy(worker); });
      }
    });
  }
  for (std::thread& caller : callers) caller.join();
  EXPECT_EQ(clashes, 0);
}

TYPED_TEST(ExecutorTest, TasksMayCallItThemselves) {
  const TypeParam executor(3);
  std::vector<std::uint64_t> sums(40);
  std::vector<std::atomic<int>> outer_tasks(3);  // at work or waiting for their own call, by worker
  std::atomic<int> clashes = 0;
  executor.for_each(sums.size(), [&](std::size_t i, int worker) {
    if (outer_tasks[worker]++ != 0) ++clashes;
    std::vector<std::uint64_t> parts(i + 1);
    executor.for_each(parts.size(), [&](std::size_t k, int) {
      std::atomic<std::uint64_t> sum = 0;
      executor.for_each(k % 3, [&](std::size_t m, int) { sum += m; });
      parts[k] = k + sum;
    });
    sums[i] = std::accumulate(parts.begin(), parts.end(), std::uint64_t{0});
    --outer_tasks[worker];
  });
  EXPECT_EQ(clashes, 0) << "a task that waits is not interrupted by another of its call";
  for (std::size_t i = 0; i < sums.size(); ++i) {
    std::uint64_t wanted = 0;
    for (std::size_t k = 0; k <= i; ++k) wanted += k + (k % 3 == 2 ? 1 : 0);
    EXPECT_EQ(sums[i], wanted);
  }
}

TYPED_TEST(ExecutorTest, HandsOnAnExceptionAndGoesOn) {
  for (const int threads : {1, 3}) {
    const TypeParam executor(threads);
    std::atomic<int> runs = 0;
    const auto throw_early = [&](std::size_t i, int) {
      ++runs;
      if (i == 2) throw Error("two");
    };
    EXPECT_THROW(executor.for_each(1'000'000, throw_early), Error);
    EXPECT_LT(runs, 1'000'000) << "the rest is left out";

    const auto nested = [&](std::size_t, int) { executor.for_each(10, throw_early); };
    EXPECT_THROW(executor.for_each(10, nested), Error);

    runs = 0;
    executor.for_each(100, [&](std::size_t, int) { ++runs; });
    EXPECT_EQ(runs, 100);
  }
}

TYPED_TEST(ExecutorTest, TwoMayBeNested) {
  const TypeParam outer(2), inner(3);
  std::atomic<int> runs = 0;
  outer.for_each(20, [&](std::size_t, int) { inner.for_each(20, [&](std::size_t, int) { ++runs; }); });
  EXPECT_EQ(runs, 400);
}

#if defined(__SSE2__)
TYPED_TEST(ExecutorTest, TasksRunInTheDefaultFloatingPointMode) {
  const unsigned saved = _mm_getcsr();
  _mm_setcsr(saved | 0x8040u);  // flush-to-zero, denormals-are-zero
  std::atomic<int> flushed = 0;
  for (const int threads : {1, 3}) {
    const TypeParam executor(threads);
    executor.for_each(100, [&](std::size_t, int) {
      volatile float smallest = std::numeric_limits<float>::min();
      if (smallest / 2 == 0) ++flushed;
    });
  }
  EXPECT_EQ(_mm_getcsr() & 0x8040u, 0x8040u) << "the caller's mode stays";
  _mm_setcsr(saved);
  EXPECT_EQ(flushed, 0);
}
#endif

TEST(ForRanges, PiecesAreInOrderAndWhole) {
  for (const int threads : {1, 2, 5}) {
    const Executor executor(threads);
    for (const std::size_t count : {0u, 1u, 9u, 10u, 11u, 12345u}) {
      std::mutex mutex;
      std::set<std::pair<std::size_t, std::size_t>> pieces;
      for_ranges(executor, count, 10, [&](std::size_t first, std::size_t last, int) {
        const std::lock_guard lock(mutex);
        pieces.emplace(first, last);
      });
      std::size_t at = 0;
      for (const auto& [first, last] : pieces) {
        EXPECT_EQ(first, at);
        EXPECT_TRUE(last - first >= 10 || pieces.size() == 1);
        at = last;
      }
      EXPECT_EQ(at, count);
      EXPECT_LE(pieces.size(), threads == 1 ? 1u : 4u * threads);
    }
  }
}

#if defined(__linux__) && !defined(__SANITIZE_THREAD__)
TEST(Executor, AForkedProcessDoesItsTasksByItself) {
  auto executor = std::make_unique<Executor>(3);
  executor->for_each(100, [](std::size_t, int) {});
  const ::pid_t child = ::fork();
  if (child == 0) {
    std::size_t done = 0;  // by one thread
    const auto count = [&](std::size_t, int worker) { done += worker == 0 ? 1 : 1000; };
    executor->for_each(100, count);
    Executor(2).for_each(100, count);
    executor.reset();
    ::_exit(done == 200 ? 0 : 1);
  }
  int status = -1;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  std::atomic<int> done = 0;
  executor->for_each(100, [&](std::size_t, int) { ++done; });
  EXPECT_EQ(done, 100);
}
#endif

#if defined(__linux__) && !defined(__SANITIZE_THREAD__) && !defined(__SANITIZE_ADDRESS__)
std::size_t pages_in_memory() {
  std::size_t all = 0, resident = 0;
  std::ifstream("/proc/self/statm") >> all >> resident;
  return resident;
}

// An arena of oneTBB that ends leaves about seven kilobytes behind.
TEST(Executor, ManyOneAfterTheOtherTakeNoMoreMemory) {
  const auto make = [](int count) {
    for (int i = 0; i < count; ++i) Executor(2 + i % 2).for_each(10, [](std::size_t, int) {});
  };
  make(100);
  const std::size_t before = pages_in_memory();
  make(2000);
  EXPECT_LE(pages_in_memory(), before + 1000);  // 4 MB; 14 were lost else
}
#endif

TEST(Executor, ZeroMeansAsManyAsMayRun) { EXPECT_GE(Executor(0).threads(), 1); }

}  // namespace
}  // namespace facemap
