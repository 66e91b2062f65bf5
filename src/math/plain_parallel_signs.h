#pragma once

#include "math/exact_sign.h"
#include "math/verdict.h"

/// The predicates of parallel_signs.h in plain doubles, each with one bound, as plain_signs.h has those of
/// exact_sign.h.
namespace facemap::plain {

int side_along(const Triangle& face, const Vector& d);
Verdict covers_along(const Triangle& face, int s, const Vector& O, const Vector& d);
Verdict blocks_along(const Triangle& G, int s_G, const Vector& d, const TruePoint& point);
Verdict blocks_along(const Triangle& G, int s_G, const Vector& d, const GivenPoint& point);

}  // namespace facemap::plain
