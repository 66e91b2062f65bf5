#pragma once

#include <cstdint>

#include "picture/asked_points.h"
#include "visibility/point_question.h"

namespace facemap {

/// Whether a point that kept bounds have in the dark may be there for no other reason than a patch with its own face,
/// which does not count.
bool may_be_dark_by_own(const PointQuestion& question, const AskedPoints& points, std::uint32_t point);

}  // namespace facemap
