#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/executor.h"
#include "picture/unset_vector.h"
#include "visibility/cell_sorter.h"
#include "visibility/point_question.h"
#include "visibility/spares.h"

namespace facemap {

/// Targets that faces are to be asked about, in the order of their cells: neighbours stand side by side then, and each
/// task gets those of few directions.
class SortedTargets {
 public:
  /// Those of a question from `first` up to `last`; sets question.visible of all of them.
  void sort(const PointQuestion& question, std::size_t first, std::size_t last, const CellSorter& sorter,
            const Executor& executor, Spares<CellScratch>& spares);

  std::size_t size() const { return size_; }
  /// Where cell `cell` begins; kCellCount: the end.
  std::size_t begin(std::size_t cell) const { return begins_[cell]; }
  /// Targets `from` up to `to` of the sorted ones.
  Viewpoint::Targets some(std::size_t from, std::size_t to) const;
  /// What the question calls a sorted target.
  std::size_t number(std::size_t sorted) const { return first_ + numbers_[sorted]; }

  std::size_t memory_bytes() const noexcept;

 private:
  void count_cells(std::size_t pieces);

  std::size_t first_ = 0, size_ = 0;
  bool has_faces_ = false;
  UnsetVector<std::uint16_t> found_, cells_;  // of each piece, from its first target on
  std::vector<std::size_t> found_count_;      // one a piece
  std::vector<std::uint32_t> places_;         // of each piece and cell the next place
  std::vector<std::size_t> begins_;
  UnsetVector<std::uint32_t> numbers_;
  UnsetVector<Vector> points_;
  UnsetVector<FaceId> faces_;
};

}  // namespace facemap
