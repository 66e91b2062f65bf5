#include "visibility/points_by_faces.h"

#include <algorithm>

#include "visibility/point_parts.h"
#include "visibility/target_points.h"

namespace facemap {
namespace {

constexpr std::size_t kMostPoints = std::size_t{1} << 22;  // at once

// For each part there is one pass over all faces.
constexpr std::size_t kFewestPointsOfPart = std::size_t{1} << 16;

int parts_for(std::size_t points, int threads) {
  const auto most = static_cast<int>(std::min<std::size_t>(points / kFewestPointsOfPart, kMostPointParts));
  return threads == 1 ? 1 : std::clamp(2 * threads, 1, std::max(most, 1));
}

// Targets from `first` on that are held as `points`.
void ask_some(const PointQuestion& question, std::size_t first, const AskedPoints& points, const Executor& executor,
              Spares<ShadowScratch>& spares) {
  std::uint8_t* const visible = question.visible.data() + first;
  const BlocksExactly hides = [&](std::size_t point, std::uint32_t face, int side) {
    return question.hides(face, side, first + point);
  };
  const auto ask = [&](const std::uint8_t* asked, int bit) {
    const Spares<ShadowScratch>::Loan scratch(spares);
    clear_blocked(question.faces, question.origin, points, {asked, visible, 1, bit}, nullptr, hides, *scratch);
  };
  const int wanted = parts_for(points.size(), executor.threads());
  if (wanted == 1) {
    std::fill_n(visible, points.size(), std::uint8_t{1});
    return ask(visible, 0);
  }
  const PointParts parts = share_points(points, question.origin, wanted, executor);
  std::copy(parts.bits.begin(), parts.bits.end(), visible);
  executor.for_each(static_cast<std::size_t>(parts.count),
                    [&](std::size_t part, int) { ask(parts.bits.data(), static_cast<int>(part)); });
  for (std::size_t i = 0; i < points.size(); ++i) visible[i] = visible[i] != 0;
}

}  // namespace

void ask_faces(const PointQuestion& question, const Executor& executor, Spares<ShadowScratch>& spares,
               ToldProgress& told) {
  for (std::size_t first = 0; first < question.size(); first += kMostPoints) {
    const std::size_t last = std::min(first + kMostPoints, question.size());
    ask_some(question, first, asked_points(question.faces, question.targets, first, last, executor), executor, spares);
    told.add(last - first);
  }
}

}  // namespace facemap
