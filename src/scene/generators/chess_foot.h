#pragma once

#include "scene/generators/lathe.h"

namespace facemap::generators {

/// The foot all pieces share: a plinth of radius `base`, a round moulding, a step; ends at (shoulder, ...) from
/// where the stem rises.
Profile turned_foot(double base, double shoulder, int detail);

}  // namespace facemap::generators
