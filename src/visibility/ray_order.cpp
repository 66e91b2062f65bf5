#include "visibility/ray_order.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

namespace facemap {
namespace {

constexpr std::size_t kFewest = 1 << 15;  // rays; fewer find their faces in the processor's own memory soon

// Runs of at least so many rays of one cell on average are left as they are.
constexpr std::size_t kLongRun = 4;

}  // namespace

// A counting sort: each of some ranges of rays counts its cells, then writes its rays to places of its own. Rays
// without a list come last.
RayOrder::RayOrder(const Executor& executor, const RayLists& lists, std::size_t count,
                   std::function<Place(std::size_t)> place_of)
    : place_of_(std::move(place_of)) {
  if (count < kFewest || count > std::numeric_limits<std::uint32_t>::max()) return;
  const auto ranges = static_cast<std::size_t>(executor.threads());
  const auto begin_of = [&](std::size_t range) { return count / ranges * range + std::min(range, count % ranges); };
  const std::size_t cells = lists.cells() + 1;
  std::vector<Place> places(count);
  const auto cell_of = [&](std::size_t i) { return std::min(RayLists::cell_of(places[i]), cells - 1); };
  std::vector<std::vector<std::uint32_t>> slots(ranges);
  std::atomic<std::size_t> runs = 0;
  executor.for_each(ranges, [&](std::size_t range, int) {
    slots[range].assign(cells, 0);
    std::size_t own_runs = 0, last = cells;
    for (std::size_t i = begin_of(range); i < begin_of(range + 1); ++i) {
      places[i] = place_of_(i);
      const std::size_t cell = cell_of(i);
      ++slots[range][cell];
      own_runs += cell != last;
      last = cell;
    }
    runs += own_runs;
  });
  if (runs * kLongRun < count) {
    places_.swap(places);
    return;
  }
  std::uint32_t slot = 0;
  for (std::size_t k = 0; k < cells; ++k) {
    for (std::size_t range = 0; range < ranges; ++range) {
      const std::uint32_t own = slots[range][k];
      slots[range][k] = slot;
      slot += own;
    }
  }
  order_.resize(count);
  places_.resize(count);
  executor.for_each(ranges, [&](std::size_t range, int) {
    for (std::size_t i = begin_of(range); i < begin_of(range + 1); ++i) {
      const std::uint32_t to = slots[range][cell_of(i)]++;
      order_[to] = static_cast<std::uint32_t>(i);
      places_[to] = places[i];
    }
  });
}

}  // namespace facemap
