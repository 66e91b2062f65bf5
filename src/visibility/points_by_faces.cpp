#include "visibility/points_by_faces.h"

#include <algorithm>
#include <optional>

#include "math/dvector.h"
#include "picture/gnomonic.h"
#include "visibility/point_sides.h"
#include "visibility/target_points.h"

namespace facemap {
namespace {

constexpr std::size_t kMostPoints = std::size_t{1} << 20;  // at once: what they take is kept

// Fewer points are not worth an order of their own.
constexpr std::size_t kFewestSorted = std::size_t{1} << 16;

// For each part there is one pass over all faces.
constexpr std::size_t kFewestPointsOfPart = std::size_t{1} << 15;

// Points of the targets from `first` up to `last`.
struct Chunk {
  std::size_t first, last;
  std::size_t size() const { return last - first; }
};

class FacesAsked {
 public:
  FacesAsked(const PointQuestion& question, const LightBounds* bounds, const Executor& executor, FacesSpares& spares)
      : question_(question), bounds_(bounds), executor_(executor), spares_(spares) {}

  void ask(const Chunk& chunk) {
    // One thread alone gains nothing from an order.
    if (chunk.size() >= kFewestSorted && (bounds_ != nullptr || executor_.threads() > 1)) {
      const auto frame = bounds_ != nullptr ? std::optional(bounds_->frame()) : frame_of_scene();
      if (frame) return ask_sorted(chunk, CellSorter(*frame, bounds_));
    }
    if (chunk.size() >= kFewestSorted && executor_.threads() > 1) return ask_by_sides(chunk);
    const AskedPoints points = asked_points(question_.faces, question_.targets, chunk.first, chunk.last, executor_);
    std::uint8_t* const visible = question_.visible.data() + chunk.first;
    std::fill_n(visible, chunk.size(), std::uint8_t{1});
    clear_hidden(question_, points, chunk.first, {visible, visible, 1, 0}, nullptr);
  }

 private:
  // The frame that all faces are in, if the origin has them in front of it.
  std::optional<simd::ShadowFrame> frame_of_scene() const {
    const DVector origin(question_.origin);
    return frame_towards(question_.origin,
                         {DVector(question_.faces.lower()) - origin, DVector(question_.faces.upper()) - origin}, 0);
  }

  // `points` are those of a question from `first` on.
  void clear_hidden(const PointQuestion& question, const AskedPoints& points, std::size_t first, const MaskBit& mask,
                    const std::vector<std::uint32_t>* some_faces) const {
    const Spares<ShadowScratch>::Loan scratch(spares_.shadows);
    clear_blocked(
        question.faces, question.origin, points, mask, nullptr,
        [&](std::size_t point, std::uint32_t face, int side) { return question.hides(face, side, first + point); },
        *scratch, nullptr, some_faces);
  }

  void ask_sorted(const Chunk& chunk, const CellSorter& sorter) const {
    const Spares<SortedTargets>::Loan sorted(spares_.sorted);
    sorted->sort(question_, chunk.first, chunk.last, sorter, executor_, spares_.cells);
    const std::vector<std::size_t> ends = ends_of_parts(*sorted);
    executor_.for_each(ends.size() - 1, [&](std::size_t part, int) {
      const bool is_odd = part + 2 == ends.size();
      ask_part(*sorted, ends[part], ends[part + 1], bounds_ != nullptr && !is_odd ? bounds_->faces() : nullptr);
    });
  }

  // The last part has the odd cell, the others about as many points each.
  std::vector<std::size_t> ends_of_parts(const SortedTargets& sorted) const {
    const std::size_t count = sorted.begin(kOddCell);
    const auto wanted = executor_.threads() == 1 ? 1 : 2 * static_cast<std::size_t>(executor_.threads());
    const std::size_t parts = std::clamp<std::size_t>(count / kFewestPointsOfPart, 1, wanted);
    std::vector<std::size_t> ends{0};
    for (std::size_t cell = 1; cell < kOddCell; ++cell) {
      if (sorted.begin(cell) >= ends.size() * count / parts && ends.size() < parts) ends.push_back(sorted.begin(cell));
    }
    ends.push_back(count);
    ends.push_back(sorted.size());
    return ends;
  }

  void ask_part(const SortedTargets& sorted, std::size_t begin, std::size_t end,
                const std::vector<std::uint32_t>* some_faces) const {
    if (begin == end) return;
    const Viewpoint::Targets targets = sorted.some(begin, end);
    const Spares<PartScratch>::Loan scratch(spares_.parts);
    std::vector<std::uint8_t>& visible = scratch->visible;
    visible.assign(end - begin, 1);
    if (scratch->points.x.capacity() < end - begin) scratch->points = points_with_room(end - begin);
    put_points(question_.faces, targets, 0, end - begin, scratch->points);
    clear_hidden({question_.faces, question_.origin, targets, visible}, scratch->points, 0,
                 {visible.data(), visible.data(), 1, 0}, some_faces);
    for (std::size_t k = 0; k < visible.size(); ++k) question_.visible[sorted.number(begin + k)] = visible[k];
  }

  void ask_by_sides(const Chunk& chunk) const {
    const AskedPoints points = asked_points(question_.faces, question_.targets, chunk.first, chunk.last, executor_);
    const UnsetVector<std::uint8_t> sides = sides_of_points(points, question_.origin, executor_);
    std::uint8_t* const visible = question_.visible.data() + chunk.first;
    std::copy(sides.begin(), sides.end(), visible);
    executor_.for_each(kPointSides, [&](std::size_t side, int) {
      clear_hidden(question_, points, chunk.first, {sides.data(), visible, 1, static_cast<int>(side)}, nullptr);
    });
    for (std::size_t i = 0; i < chunk.size(); ++i) visible[i] = visible[i] != 0;
  }

  const PointQuestion& question_;
  const LightBounds* bounds_;
  const Executor& executor_;
  FacesSpares& spares_;
};

}  // namespace

void ask_faces(const PointQuestion& question, const LightBounds* bounds, const Executor& executor, FacesSpares& spares,
               ToldProgress& told) {
  FacesAsked faces(question, bounds, executor, spares);
  for (std::size_t first = 0; first < question.size(); first += kMostPoints) {
    const Chunk chunk{first, std::min(first + kMostPoints, question.size())};
    faces.ask(chunk);
    told.add(chunk.size());
  }
}

}  // namespace facemap
