#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/executor.h"
#include "picture/bytes_of.h"
#include "picture/light_bounds.h"
#include "picture/shadows.h"
#include "visibility/cell_sorter.h"
#include "visibility/point_question.h"
#include "visibility/sorted_targets.h"
#include "visibility/spares.h"
#include "visibility/told_progress.h"

namespace facemap {

/// Working memory of a task that has a part of the points.
struct PartScratch {
  AskedPoints points;
  std::vector<std::uint8_t> visible;

  std::size_t memory_bytes() const noexcept { return bytes_of(points) + bytes_of(visible); }
};

/// Memory that questions to faces work in.
struct FacesSpares {
  Spares<ShadowScratch> shadows;
  Spares<PartScratch> parts;
  Spares<CellScratch> cells;
  Spares<SortedTargets> sorted;

  std::size_t memory_bytes() const {
    return shadows.memory_bytes() + parts.memory_bytes() + cells.memory_bytes() + sorted.memory_bytes();
  }
};

/// Answers a question by holding the faces of its scene against its points: points are sorted into rasters about the
/// origin and all faces run over them (clear_blocked of picture/shadows.h), one part of the directions a task.
/// `bounds`, or null: kept ones, that decide many points beforehand. Tolerance 0.
void ask_faces(const PointQuestion& question, const LightBounds* bounds, const Executor& executor, FacesSpares& spares,
               ToldProgress& told);

}  // namespace facemap
