#pragma once

#include "parallel/executor.h"
#include "picture/shadows.h"
#include "visibility/point_question.h"
#include "visibility/spares.h"
#include "visibility/told_progress.h"

namespace facemap {

/// Answers a question with nothing kept: points are sorted into rasters about the origin and all faces run over them
/// (clear_blocked of picture/shadows.h), one part of the directions a task. Tolerance 0.
void ask_faces(const PointQuestion& question, const Executor& executor, Spares<ShadowScratch>& spares,
               ToldProgress& told);

}  // namespace facemap
