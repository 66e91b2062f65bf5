#include "visibility/sorted_targets.h"

#include <algorithm>
#include <memory>

#include "picture/bytes_of.h"

namespace facemap {
namespace {

constexpr std::size_t kPiece = CellSorter::kPiece;

// Room that is written for the first time by the tasks that need it.
template <class Value>
void make_room(UnsetVector<Value>& values, std::size_t count) {
  if (values.capacity() < count) {
    values = UnsetVector<Value>();  // first, so that both are not held together
    const auto pages = std::make_shared<SharedPages>(SharedPages::room_for<Value>(count));
    values = UnsetVector<Value>(UnsetAllocator<Value>(pages));
  }
  values.resize(count);
}

}  // namespace

void SortedTargets::sort(const PointQuestion& question, std::size_t first, std::size_t last, const CellSorter& sorter,
                         const Executor& executor, Spares<CellScratch>& spares) {
  const std::size_t count = last - first, pieces = (count + kPiece - 1) / kPiece;
  first_ = first;
  has_faces_ = !question.targets.faces.empty();
  make_room(found_, count);
  make_room(cells_, count);
  found_count_.assign(pieces, 0);
  places_.assign(pieces * kCellCount, 0);
  executor.for_each(pieces, [&](std::size_t piece, int) {
    const Spares<CellScratch>::Loan scratch(spares);
    const std::size_t from = piece * kPiece, to = std::min(from + kPiece, count);
    std::uint16_t* const cells = &cells_[from];
    found_count_[piece] = sorter.find_cells(question, first + from, first + to, *scratch, &found_[from], cells);
    std::uint32_t* const counts = &places_[piece * kCellCount];
    for (std::size_t k = 0; k < found_count_[piece]; ++k) ++counts[cells[k]];
  });
  count_cells(pieces);
  make_room(numbers_, size_);
  make_room(points_, size_);
  if (has_faces_) make_room(faces_, size_);
  executor.for_each(pieces, [&](std::size_t piece, int) {
    const std::size_t from = piece * kPiece;
    std::uint32_t* const places = &places_[piece * kCellCount];
    for (std::size_t k = from; k < from + found_count_[piece]; ++k) {
      const std::uint32_t place = places[cells_[k]]++;
      const std::size_t number = from + found_[k];
      numbers_[place] = static_cast<std::uint32_t>(number);
      points_[place] = question.targets.points[first + number];
      if (has_faces_) faces_[place] = question.targets.faces[first + number];
    }
  });
}

// From counts to places: cell by cell, piece by piece.
void SortedTargets::count_cells(std::size_t pieces) {
  begins_.assign(kCellCount + 1, 0);
  std::uint32_t sum = 0;
  for (std::size_t cell = 0; cell < kCellCount; ++cell) {
    begins_[cell] = sum;
    for (std::size_t piece = 0; piece < pieces; ++piece) {
      const std::uint32_t count = places_[piece * kCellCount + cell];
      places_[piece * kCellCount + cell] = sum;
      sum += count;
    }
  }
  size_ = begins_[kCellCount] = sum;
}

Viewpoint::Targets SortedTargets::some(std::size_t from, std::size_t to) const {
  Viewpoint::Targets targets{std::span(points_).subspan(from, to - from)};
  if (has_faces_) targets.faces = std::span(faces_).subspan(from, to - from);
  return targets;
}

std::size_t SortedTargets::memory_bytes() const noexcept {
  return sizeof(*this) + bytes_of(found_) + bytes_of(cells_) + bytes_of(found_count_) + bytes_of(places_) +
         bytes_of(begins_) + bytes_of(numbers_) + bytes_of(points_) + bytes_of(faces_);
}

}  // namespace facemap
