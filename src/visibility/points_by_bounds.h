#pragma once

#include <cstdint>
#include <vector>

#include "parallel/executor.h"
#include "picture/decide_points.h"
#include "picture/light_bounds.h"
#include "picture/shadows.h"
#include "visibility/point_question.h"
#include "visibility/spares.h"
#include "visibility/told_progress.h"

namespace facemap {

/// Working memory of a task of ask_bounds.
struct BoundsScratch {
  AskedPoints points;
  DecidedPoints decided;

  std::size_t memory_bytes() const noexcept;
};

/// Answers a question by bounds with lists that are kept: each point by itself, a piece of the points a task.
/// Tolerance 0.
void ask_bounds(const LightBounds& bounds, const PointQuestion& question, const Executor& executor,
                Spares<BoundsScratch>& spares, Spares<ShadowScratch>& spares_for_rest, ToldProgress& told);

}  // namespace facemap
