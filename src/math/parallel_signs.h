#pragma once

#include "math/exact_sign.h"

/// The predicates of exact_sign.h for parallel light and for parallel cameras, which have a direction d in place of an
/// origin. As exact as those, by the same stages; docs/algorithm.md, "Parallel light", has the derivations.
///
/// Parallel light goes along d. It is the limit of a light at P - t d for t to infinity, and more: for each point P and
/// each face the two give the same answer from some finite t on. A parallel camera's rays are O + t d, with t > 0 and
/// an origin O for each. s = sign n . d takes the place of a side: -1 if the face is turned towards where the light
/// comes from (or the rays), 1 if away, 0 if edge-on, and then the face neither blocks nor is hit. d is float32, of any
/// length; a zero d makes every side 0. What else holds unchanged with s in place of a side:
///  - compare_depth orders what parallel rays hit;
///  - a TruePoint of a parallel ray has K = O;
///  - reaches_beyond, which face G of side s_G blocks no point of F.
/// Inputs must be finite.
namespace facemap {

/// s: sign of n . d, -1, 0 or 1.
int side_along(const Triangle& face, const Vector& d, Counters* counters = nullptr);

/// Whether the ray O + t d, t > 0, meets the face: s det(a-O, b-O, d) >= 0 for its edges, and s n . (a-O) > 0.
/// `s` must be side_along(face, d). Edges and vertices count as inside; a face through O is not seen. The same as
/// covers with side(face, O), but that s does not depend on O.
Covering covers_along(const Triangle& face, int s, const Vector& O, const Vector& d, Counters* counters = nullptr);

/// Whether face G (s_G = side_along(G, d)) stands strictly between the point and where the light comes from:
/// s_G det(a-P, b-P, d) >= 0 for its edges, and s_G n . (P-a) > 0. False if s_G is 0. A point on G's plane is not
/// blocked by G.
bool blocks_along(const Triangle& G, int s_G, const Vector& d, const TruePoint& point, Counters* counters = nullptr);
bool blocks_along(const Triangle& G, int s_G, const Vector& d, const GivenPoint& point, Counters* counters = nullptr);

/// Whether parallel light falls on the side of the face that a camera sees: strictly, so that light along its plane
/// leaves a face dark. `s_camera` is side(face, K), or side_along(face, the rays' direction).
bool is_facing_along(const Triangle& face, int s_camera, const Vector& d, Counters* counters = nullptr);

}  // namespace facemap
