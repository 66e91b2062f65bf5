#pragma once

#include <facemap/counters.h>
#include <facemap/vector.h>

#include <array>

#include "math/tracked.h"

/// Signs of expressions over the real numbers that float32 inputs are. Nothing is rounded first: doubles with one bound
/// made of the sizes of the inputs (plain_signs.h) decide if they can, integers on the stack (numbers.h) decide the
/// rest. The float32 filter in front of both works on prepared planes (map/face_planes.h).
///
/// Letters: O a map's origin, L a light's, K a camera's; a, b, c the corners of a face; n = (b-a) x (c-a);
/// s = sign det(a-O, b-O, c-O), -1 if the face is turned towards O, 1 if away, 0 if seen edge-on.
/// Inputs must be finite. Sources: design contract in docs/algorithm.md; Shewchuk 1997 for the scheme of stages.
namespace facemap {

using Triangle = std::array<Vector, 3>;

/// Whether the corners lie exactly on one line (or coincide).
bool is_degenerate(const Vector& a, const Vector& b, const Vector& c);

/// s above: sign of det(a-O, b-O, c-O), -1, 0 or 1.
int side(const Triangle& face, const Vector& O, Counters* counters = nullptr);

/// Whether the ray from O along d meets the face: s det(a,b,d), s det(b,c,d), s det(c,a,d) >= 0 about O.
/// `s` must be side(face, O); false if it is 0 or d is zero. Edges and vertices count as inside.
struct Covering {
  bool hit = false;
  bool strictly_inside = false;  ///< no edge sign is 0
};
Covering covers(const Triangle& face, int s, const Vector& O, const Vector& d, Counters* counters = nullptr);

/// Sign of t1 - t2, where t is the parameter at which O + t d meets the plane of each face; both faces must be
/// hit (side s1, s2 not 0).
int compare_depth(const Triangle& face1, int s1, const Triangle& face2, int s2, const Vector& O, const Vector& d,
                  Counters* counters = nullptr);

/// The same along the segment from O to P, both faces standing strictly between (as blocks() has it).
int compare_depth_towards(const Triangle& face1, int s1, const Triangle& face2, int s2, const Vector& O,
                          const Vector& P, Counters* counters = nullptr);

/// Share of the way from O to P at which a face that stands strictly between is met, with its error bound.
Tracked segment_parameter(const Triangle& face, const Vector& O, const Vector& P);

/// A point that a camera sees: where the ray K + t d meets the plane of `face`, a rational point.
struct TruePoint {
  Vector K, d;
  Triangle face;
  int s = 0;  ///< side(face, K), not 0
};

/// A point that a user gave, optionally projected onto the plane of the face it was sampled from.
struct GivenPoint {
  Vector P;
  const Triangle* on_face = nullptr;  ///< not degenerate
  float tolerance = 0;                ///< world units: G blocks only if P is farther than this from G's plane
};

/// Whether face G (side s_G from L) stands strictly between L and the point. False if s_G is 0. A point on G's
/// plane is not blocked by G.
bool blocks(const Triangle& G, int s_G, const Vector& L, const TruePoint& point, Counters* counters = nullptr);
bool blocks(const Triangle& G, int s_G, const Vector& L, const GivenPoint& point, Counters* counters = nullptr);

/// Whether a corner of F stands strictly beyond G's plane, seen from where G's side is s_G. If none does, G blocks no
/// point of F, whose points are means of its corners: so it is if F lies in G's plane.
bool reaches_beyond(const Triangle& F, const Triangle& G, int s_G, Counters* counters = nullptr);

/// Parameter t of a true point, with its error bound.
Tracked ray_parameter(const TruePoint& point);

/// The same, sharpened to a relative error of 2^-30 in integers where `t = ray_parameter(point)` is worse.
double sharp_ray_parameter(const TruePoint& point, const Tracked& t);

/// Largest error of a direction handed to a map, relative to its length.
inline constexpr double kDirectionError = 0x1p-40;

/// P - L for the true point, each with |error| <= kDirectionError |P - L|. `t` must be ray_parameter(point).
/// Throws Error if the ray lies along the plane, or anything is not finite: there is no such point.
DVector offset_from(const Vector& L, const TruePoint& point, const Tracked& t);

/// P - L for a given point (projected if it names a face), to the same error; zero only if it is exactly zero.
DVector offset_from(const Vector& L, const GivenPoint& point);

}  // namespace facemap
