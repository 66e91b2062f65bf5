#include "parallel/executor.h"

#include <tbb/blocked_range.h>
#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "simd/floating_point_mode.h"

namespace facemap {

class Executor::Pool {
 public:
  explicit Pool(int threads) : arena_(threads) {}

  void for_each(std::size_t count, const Task& task) {
    arena_.execute([&] {
      tbb::parallel_for(
          tbb::blocked_range<std::size_t>(0, count, 1),
          [&](const tbb::blocked_range<std::size_t>& range) {
            const FloatingPointMode mode;
            for (std::size_t i = range.begin(); i != range.end(); ++i) {
              task(i, tbb::this_task_arena::current_thread_index());
            }
          },
          tbb::simple_partitioner());
    });
  }

 private:
  tbb::task_arena arena_;
};

Executor::Executor(int threads) : threads_(threads > 0 ? threads : std::max(1, tbb::info::default_concurrency())) {
  if (threads_ > 1) pool_ = std::make_unique<Pool>(threads_);
}

Executor::~Executor() = default;

void Executor::for_each(std::size_t count, const Task& task) const {
  if (pool_ != nullptr && count > 1) {
    pool_->for_each(count, task);
    return;
  }
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
