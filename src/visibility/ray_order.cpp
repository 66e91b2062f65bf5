#include "visibility/ray_order.h"

#include <algorithm>
#include <atomic>
#include <limits>

namespace facemap {
namespace {

constexpr std::size_t kFewest = 1 << 15;  // rays; fewer find their faces in the processor's own memory soon

// Runs of at least so many rays of one cell on average are left as they are.
constexpr std::size_t kLongRun = 4;

}  // namespace

// A counting sort: each of some ranges of rays counts its cells, then writes its rays to places of its own.
RayOrder::RayOrder(const Executor& executor, std::size_t count, std::size_t cells,
                   const std::function<std::uint32_t(std::size_t)>& cell_of) {
  if (count < kFewest || count > std::numeric_limits<std::uint32_t>::max()) return;
  const std::size_t ranges = static_cast<std::size_t>(executor.threads());
  const auto begin_of = [&](std::size_t range) { return count / ranges * range + std::min(range, count % ranges); };
  std::vector<std::uint32_t> cell(count);
  std::vector<std::vector<std::uint32_t>> places(ranges);
  std::atomic<std::size_t> runs = 0;
  executor.for_each(ranges, [&](std::size_t range, int) {
    places[range].assign(cells, 0);
    std::size_t own_runs = 0;
    for (std::size_t i = begin_of(range); i < begin_of(range + 1); ++i) {
      cell[i] = cell_of(i);
      ++places[range][cell[i]];
      own_runs += i == begin_of(range) || cell[i] != cell[i - 1];
    }
    runs += own_runs;
  });
  if (runs * kLongRun < count) return;
  std::uint32_t place = 0;
  for (std::size_t k = 0; k < cells; ++k) {
    for (std::size_t range = 0; range < ranges; ++range) {
      const std::uint32_t own = places[range][k];
      places[range][k] = place;
      place += own;
    }
  }
  order_.resize(count);
  executor.for_each(ranges, [&](std::size_t range, int) {
    for (std::size_t i = begin_of(range); i < begin_of(range + 1); ++i) {
      order_[places[range][cell[i]]++] = static_cast<std::uint32_t>(i);
    }
  });
}

}  // namespace facemap
