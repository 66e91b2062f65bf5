#include "math/exact_sign.h"

#include <facemap/error.h>
#include <gmpxx.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "math/exact_stage.h"
#include "math/expressions.h"
#include "math/numbers.h"
#include "math/plain_signs.h"

namespace facemap {
namespace {

// Relative error of a parameter that plain doubles may leave: far below what a sharp depth or direction takes.
constexpr double kPlainlySharp = 0x1p-43;

constexpr const char* kNoPoint = "the ray of a surface point does not meet the plane of its face";

// Strictly beyond G's plane, and within the cone of its edges. `s` is that of G times the sign of the point's w.
template <class Numbers, class Point>
bool is_behind(const Numbers& numbers, const Triangle& G, int s, const Vector& L, const Point& point) {
  const int beyond = s * dot(normal(numbers, G), point.from(numbers, G[0])).sign();
  if (beyond <= 0) return false;
  bool strictly_inside = true;
  return is_within_edges(numbers, G, s, L, point.from(numbers, L), &strictly_inside);
}

template <class Point>
bool blocks_staged(const Triangle& G, int s_G, const Vector& L, const Point& point, Counters* counters) {
  if (s_G == 0) return false;
  const Verdict in_double = plain::blocks(G, s_G, L, point);
  count_stage(in_double != Verdict::Unknown, counters);
  if (in_double != Verdict::Unknown) return in_double == Verdict::Yes;
  return in_integers(lengths_of(G, point, L), directions_of(point), [&](const auto& numbers) {
    return blocks_rational(numbers, G, s_G, point,
                           [&](const auto& P, int s) { return is_behind(numbers, G, s, L, P); });
  });
}

// Sign of depth_difference.
int depth_sign(const Triangle& face1, const Triangle& face2, const Vector& O, const Vector& d, Counters* counters) {
  const int in_double = plain::depth_difference(face1, face2, O, d);
  count_stage(in_double != kUnknownSign, counters);
  if (in_double != kUnknownSign) return in_double;
  return in_integers(lengths_of(face1, face2, O), ExponentRange::of(d), [&](const auto& numbers) {
    return depth_difference(numbers, face1, face2, O, numbers.direction(d)).sign();
  });
}

int depth_sign_towards(const Triangle& face1, const Triangle& face2, const Vector& O, const Vector& P,
                       Counters* counters) {
  const int in_double = plain::depth_difference_towards(face1, face2, O, P);
  count_stage(in_double != kUnknownSign, counters);
  if (in_double != kUnknownSign) return in_double;
  ExponentRange lengths = lengths_of(face1, face2, O);
  lengths.include(P);
  return in_integers(lengths, ExponentRange(), [&](const auto& numbers) {
    return depth_difference(numbers, face1, face2, O, numbers.difference(P, O)).sign();
  });
}

// ---- quotients ------------------------------------------------------------------------------------------

bool is_finite(const Vector& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

bool is_finite(const TruePoint& p) {
  return is_finite(p.K) && is_finite(p.d) && is_finite(p.face[0]) && is_finite(p.face[1]) && is_finite(p.face[2]);
}
bool is_finite(const GivenPoint&) { return true; }  // checked where it was given

template <int N>
mpz_class gmp_from(const Integer<N>& value) {
  const Integer<N> magnitude = value.is_negative() ? -value : value;
  mpz_class result;
  mpz_import(result.get_mpz_t(), N, -1, sizeof(std::uint64_t), 0, 0, magnitude.limbs.data());
  return value.is_negative() ? mpz_class(-result) : result;
}

// numerator / denominator * 2^exponent, rounded towards zero.
template <int A, int B>
double quotient(const Integer<A>& numerator, const Integer<B>& denominator, int exponent) {
  mpz_class x = gmp_from(numerator), w = gmp_from(denominator);
  if (exponent > 0) x <<= static_cast<unsigned long>(exponent);
  if (exponent < 0) w <<= static_cast<unsigned long>(-exponent);
  mpq_class q(x, w);
  q.canonicalize();
  return q.get_d();
}

// P - L in world units, from integers in units of 2^exponent.
template <class Numbers, class Point>
DVector offset_in(const Numbers& numbers, const Point& point, const Vector& L, int exponent) {
  if (point.w.sign() == 0) throw Error(kNoPoint);
  const auto X = point.from(numbers, L);
  return {quotient(X.x, point.w, exponent), quotient(X.y, point.w, exponent), quotient(X.z, point.w, exponent)};
}

template <class Numbers>
auto rational_point(const Numbers& numbers, const TruePoint& p) {
  return point_on_ray(numbers, p);
}
template <class Numbers>
auto rational_point(const Numbers& numbers, const GivenPoint& p) {
  return projected_point(numbers, p.P, *p.on_face);
}

template <class Point>
DVector exact_offset(const Point& point, const Vector& L) {
  if (!is_finite(point)) throw Error(kNoPoint);
  const ExponentRange lengths = lengths_of(point, L);
  return in_integers(lengths, directions_of(point), [&](const auto& numbers) {
    return offset_in(numbers, rational_point(numbers, point), L, lengths.lowest() - ExponentRange::kUnitOfField);
  });
}

// Whether an offset that is off by at most `error` is known to within kDirectionError of its length.
bool is_sharp(const DVector& offset, double error) {
  const double length = std::sqrt(offset.x * offset.x + offset.y * offset.y + offset.z * offset.z);
  return error <= 0.5 * kDirectionError * length && length > 0x1p-400 && length < 0x1p400;
}

Tracked tracked_ray_parameter(const TruePoint& point) {
  constexpr TrackedNumbers numbers;
  const Vec3<Tracked> n = normal(numbers, point.face);
  return quotient(determinant(numbers, point.face, n, point.K), dot(n, numbers.direction(point.d)));
}

}  // namespace

bool is_degenerate(const Vector& a, const Vector& b, const Vector& c) {
  const Triangle f{a, b, c};
  if (plain::has_area(f)) return false;
  return in_integers(ExponentRange::of(a, b, c), ExponentRange(), [&](const auto& numbers) {
    const auto n = normal(numbers, f);
    return n.x.sign() == 0 && n.y.sign() == 0 && n.z.sign() == 0;
  });
}

int side(const Triangle& face, const Vector& O, Counters* counters) {
  const int in_double = plain::side(face, O);
  count_stage(in_double != kUnknownSign, counters);
  if (in_double != kUnknownSign) return in_double;
  return in_integers(lengths_of(face, O), ExponentRange(),
                     [&](const auto& numbers) { return determinant(numbers, face, normal(numbers, face), O).sign(); });
}

Covering covers(const Triangle& face, int s, const Vector& O, const Vector& d, Counters* counters) {
  if (s == 0 || (d.x == 0 && d.y == 0 && d.z == 0)) return {};
  const Verdict in_double = plain::covers(face, s, O, d);
  count_stage(in_double != Verdict::Unknown, counters);
  if (in_double != Verdict::Unknown) return {in_double == Verdict::Yes, in_double == Verdict::Yes};
  return in_integers(lengths_of(face, O), ExponentRange::of(d), [&](const auto& numbers) {
    bool strictly_inside = true;
    const bool hit = is_within_edges(numbers, face, s, O, numbers.direction(d), &strictly_inside);
    return Covering{hit, hit && strictly_inside};
  });
}

int compare_depth(const Triangle& face1, int s1, const Triangle& face2, int s2, const Vector& O, const Vector& d,
                  Counters* counters) {
  return s1 * s2 * depth_sign(face1, face2, O, d, counters);
}

int compare_depth_towards(const Triangle& face1, int s1, const Triangle& face2, int s2, const Vector& O,
                          const Vector& P, Counters* counters) {
  return s1 * s2 * depth_sign_towards(face1, face2, O, P, counters);
}

Tracked segment_parameter(const Triangle& face, const Vector& O, const Vector& P) {
  return plain::segment_parameter(face, O, P);
}

bool blocks(const Triangle& G, int s_G, const Vector& L, const TruePoint& point, Counters* counters) {
  return blocks_staged(G, s_G, L, point, counters);
}

bool blocks(const Triangle& G, int s_G, const Vector& L, const GivenPoint& point, Counters* counters) {
  return blocks_staged(G, s_G, L, point, counters);
}

bool reaches_beyond(const Triangle& F, const Triangle& G, int s_G, Counters* counters) {
  const Verdict in_double = plain::reaches_beyond(F, G, s_G);
  count_stage(in_double != Verdict::Unknown, counters);
  if (in_double != Verdict::Unknown) return in_double == Verdict::Yes;
  ExponentRange lengths = ExponentRange::of(F[0], F[1], F[2]);
  for (const Vector& corner : G) lengths.include(corner);
  return in_integers(lengths, ExponentRange(), [&](const auto& numbers) {
    const auto n = normal(numbers, G);
    return std::any_of(F.begin(), F.end(), [&](const Vector& corner) {
      return s_G * determinant(numbers, G, n, corner).sign() < 0;  // the other side than the light's
    });
  });
}

Tracked ray_parameter(const TruePoint& point) {
  const Tracked t = plain::ray_parameter(point);
  return t.error < kPlainlySharp * std::fabs(t.value) ? t : tracked_ray_parameter(point);
}

double sharp_ray_parameter(const TruePoint& point, const Tracked& t) {
  if (t.error < 0x1p-30 * t.value) return t.value;  // false if both are infinite: a slope rounded to 0
  const ExponentRange lengths = lengths_of(point.face, point.K), directions = directions_of(point);
  return in_integers(lengths, directions, [&](const auto& numbers) {
    const auto n = normal(numbers, point.face);
    return quotient(determinant(numbers, point.face, n, point.K), dot(n, numbers.direction(point.d)),
                    lengths.lowest() - directions.lowest());
  });
}

DVector offset_from(const Vector& L, const TruePoint& point, const Tracked& t) {
  DVector offset;
  if (is_sharp(offset, plain::offset(L, point, t, &offset))) return offset;
  constexpr TrackedNumbers numbers;
  const Vec3<Tracked> D = numbers.difference(point.K, L) + tracked_ray_parameter(point) * numbers.direction(point.d);
  offset = {D.x.value, D.y.value, D.z.value};
  if (is_sharp(offset, (D.x.error + D.y.error + D.z.error) * (1 + Tracked::kInflation))) return offset;
  return exact_offset(point, L);
}

DVector offset_from(const Vector& L, const GivenPoint& point) {
  if (point.on_face == nullptr) {
    return {double(point.P.x) - double(L.x), double(point.P.y) - double(L.y), double(point.P.z) - double(L.z)};
  }
  return exact_offset(point, L);
}

}  // namespace facemap
