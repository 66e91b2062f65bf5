#pragma once

#include "math/exact_sign.h"
#include "math/verdict.h"

/// The predicates of exact_sign.h in plain doubles, each with one bound made of the sizes of its inputs: what nearly
/// all tests that the float32 filter leaves open need. A sign that the bound does not settle is kUnknownSign.
namespace facemap::plain {

int side(const Triangle& face, const Vector& O);
Verdict covers(const Triangle& face, int s, const Vector& O, const Vector& d);

/// Sign of depth_difference (expressions.h).
int depth_difference(const Triangle& face1, const Triangle& face2, const Vector& O, const Vector& d);

Verdict blocks(const Triangle& G, int s_G, const Vector& L, const TruePoint& point);
Verdict blocks(const Triangle& G, int s_G, const Vector& L, const GivenPoint& point);

}  // namespace facemap::plain
