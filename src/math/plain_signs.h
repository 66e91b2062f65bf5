#pragma once

#include "math/exact_sign.h"
#include "math/tracked.h"
#include "math/verdict.h"

/// The predicates of exact_sign.h in plain doubles, each with one bound made of the sizes of its inputs: what nearly
/// all tests that the float32 filter leaves open need. A sign that the bound does not settle is kUnknownSign.
namespace facemap::plain {

/// Surely; false: it may have none.
bool has_area(const Triangle& face);

int side(const Triangle& face, const Vector& O);
Verdict covers(const Triangle& face, int s, const Vector& O, const Vector& d);

/// Sign of depth_difference (expressions.h), along a direction and from O to a point P.
int depth_difference(const Triangle& face1, const Triangle& face2, const Vector& O, const Vector& d);
int depth_difference_towards(const Triangle& face1, const Triangle& face2, const Vector& O, const Vector& P);

Verdict blocks(const Triangle& G, int s_G, const Vector& L, const TruePoint& point);
Verdict blocks(const Triangle& G, int s_G, const Vector& L, const GivenPoint& point);

Verdict reaches_beyond(const Triangle& F, const Triangle& G, int s_G);

/// As facemap::ray_parameter, of the same value, with a larger bound of its error.
Tracked ray_parameter(const TruePoint& point);

/// As facemap::segment_parameter.
Tracked segment_parameter(const Triangle& face, const Vector& O, const Vector& P);

/// Writes P - L, of the same value as in Tracked, for t = ray_parameter(point); returns a bound of the errors of its
/// components' sum.
double offset(const Vector& L, const TruePoint& point, const Tracked& t, DVector* offset);

}  // namespace facemap::plain
