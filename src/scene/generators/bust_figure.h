#pragma once

#include <facemap/vector.h>

namespace facemap::generators {

/// The field of a head with neck and shoulders that looks towards +z: negative inside, see sculpt.h. The eyes lie
/// at y = 0, the chin at -1.15, the crown at 1.15; the shoulders end in a flat cut at y = kBustCut.
double bust_figure(const DVector& point);

inline constexpr double kBustCut = -3.40;

}  // namespace facemap::generators
