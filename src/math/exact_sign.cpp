#include "math/exact_sign.h"

#include <facemap/error.h>
#include <gmpxx.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "math/vec3.h"

namespace facemap {
namespace {

// ---- the two number types -------------------------------------------------------------------------------

// Every finite float32 is an integer times 2^-149, so after one common scaling all inputs are integers. Each
// expression below is homogeneous in world lengths and in directions: the scaling leaves its sign alone.
constexpr int kFloatExponentShift = 149;

mpz_class integer_from(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  const auto exponent_field = (bits >> 23) & 0xffu;
  const unsigned long fraction = bits & 0x7fffffu;
  mpz_class result = exponent_field == 0 ? fraction : fraction | 0x800000u;
  if (exponent_field > 1) result <<= exponent_field - 1;
  if (bits >> 31) result = -result;
  return result;
}

template <class T>
T number(float value);
template <>
Tracked number<Tracked>(float value) {
  return Tracked::exact(value);
}
template <>
mpz_class number<mpz_class>(float value) {
  return integer_from(value);
}

template <class T>
T difference(float a, float b);
template <>
Tracked difference<Tracked>(float a, float b) {
  return Tracked::difference(a, b);
}
template <>
mpz_class difference<mpz_class>(float a, float b) {
  return integer_from(a) - integer_from(b);
}

template <class T>
T one();
template <>
Tracked one<Tracked>() {
  return Tracked::exact(1);
}
template <>
mpz_class one<mpz_class>() {
  return 1;
}

int sign_of(const Tracked& x) { return x.sign(); }
int sign_of(const mpz_class& x) { return sgn(x); }

template <class T>
Vec3<T> vec(const Vector& a) {
  return {number<T>(a.x), number<T>(a.y), number<T>(a.z)};
}

template <class T>
Vec3<T> vec(const Vector& a, const Vector& b) {  // a - b
  return {difference<T>(a.x, b.x), difference<T>(a.y, b.y), difference<T>(a.z, b.z)};
}

// ---- the expressions, written once ----------------------------------------------------------------------

// n = (b - a) x (c - a), from the vertices themselves: never a x b about the origin, whose factors are
// nearly parallel.
template <class T>
Vec3<T> normal(const Triangle& f) {
  return cross(vec<T>(f[1], f[0]), vec<T>(f[2], f[0]));
}

// det(a - O, b - O, d) = ((a - O) x (b - a)) . d
template <class T>
T edge(const Vector& a, const Vector& b, const Vector& O, const Vec3<T>& d) {
  return dot(cross(vec<T>(a, O), vec<T>(b, a)), d);
}

// det(a - O, b - O, c - O) = n . (a - O)
template <class T>
T determinant(const Triangle& f, const Vec3<T>& n, const Vector& O) {
  return dot(n, vec<T>(f[0], O));
}

// P - L = X / w with w > 0.
template <class T>
struct Target {
  Vec3<T> X;
  T w;
};

// w' (K - L) + delta d over w', w' = n . d, made positive by s: a ray that hits its face has s w' > 0.
template <class T>
Target<T> target(const TruePoint& p, const Vector& L) {
  const Vec3<T> n = normal<T>(p.face), d = vec<T>(p.d);
  const T w = dot(n, d), delta = determinant(p.face, n, p.K);
  const Vec3<T> X = w * vec<T>(p.K, L) + delta * d;
  if (p.s > 0) return {X, w};
  return {{T(-X.x), T(-X.y), T(-X.z)}, T(-w)};
}

// The orthogonal projection of P onto the plane of the named face, or P itself.
template <class T>
Target<T> target(const GivenPoint& p, const Vector& L) {
  if (p.on_face == nullptr) return {vec<T>(p.P, L), one<T>()};  // no length in w: not scaled
  const Vec3<T> n = normal<T>(*p.on_face);
  const T w = dot(n, n), height = dot(n, vec<T>(p.P, (*p.on_face)[0]));
  return {w * vec<T>(p.P, L) - height * n, w};
}

// ---- stages ---------------------------------------------------------------------------------------------

// Runs `expression` in double, and in integers if its sign stays unknown.
template <class Expression>
int staged_sign(Expression expression, Counters* counters) {
  const int in_double = sign_of(expression(Tracked{}));
  if (in_double != Tracked::kUnknown) {
    if (counters != nullptr) ++counters->by_double;
    return in_double;
  }
  if (counters != nullptr) ++counters->by_exact;
  return sign_of(expression(mpz_class{}));
}

// A conjunction of signs: No as soon as one condition surely fails, Unknown if none fails and one is unknown.
enum class Verdict { No, Yes, Unknown };

struct Conjunction {
  Verdict verdict = Verdict::Yes;

  void require(int sign, bool holds) {
    if (sign == Tracked::kUnknown) {
      if (verdict == Verdict::Yes) verdict = Verdict::Unknown;
    } else if (!holds) {
      verdict = Verdict::No;
    }
  }
};

template <class T>
Conjunction covers_stage(const Triangle& f, int s, const Vector& O, const Vec3<T>& d, bool* strictly_inside) {
  Conjunction all;
  for (int i = 0; i < 3; ++i) {
    const int sign = sign_of(edge<T>(f[i], f[(i + 1) % 3], O, d));
    all.require(sign, s * sign >= 0);
    if (all.verdict == Verdict::No) break;
    if (strictly_inside != nullptr && sign == 0) *strictly_inside = false;
  }
  return all;
}

// Farther than the tolerance from G's plane: (n . (P - a))^2 > tolerance^2 n . n
template <class T>
int outside_tolerance(const Vec3<T>& n, const Triangle& G, const GivenPoint& p) {
  const T height = dot(n, vec<T>(p.P, G[0])), e = number<T>(p.tolerance);
  return sign_of(T(T(height * height) - T(T(e * e) * dot(n, n))));
}
template <class T>
int outside_tolerance(const Vec3<T>&, const Triangle&, const TruePoint&) {
  return 1;
}
bool has_tolerance(const GivenPoint& p) { return p.tolerance > 0; }
bool has_tolerance(const TruePoint&) { return false; }

template <class T, class Point>
Verdict blocks_stage(const Triangle& G, int s_G, const Vector& L, const Point& point) {
  const Target<T> t = target<T>(point, L);
  const Vec3<T> n = normal<T>(G);
  Conjunction all;
  const int beyond = sign_of(T(dot(n, t.X) - T(t.w * determinant(G, n, L))));
  all.require(beyond, s_G * beyond > 0);
  if (all.verdict == Verdict::No) return all.verdict;
  const Conjunction cone = covers_stage<T>(G, s_G, L, t.X, nullptr);
  if (cone.verdict == Verdict::No) return cone.verdict;
  if (cone.verdict == Verdict::Unknown) all.verdict = Verdict::Unknown;
  if (has_tolerance(point)) {
    const int far = outside_tolerance<T>(n, G, point);
    all.require(far, far > 0);
  }
  return all.verdict;
}

template <class Point>
bool blocks_staged(const Triangle& G, int s_G, const Vector& L, const Point& point, Counters* counters) {
  if (s_G == 0) return false;
  const Verdict in_double = blocks_stage<Tracked>(G, s_G, L, point);
  if (in_double != Verdict::Unknown) {
    if (counters != nullptr) ++counters->by_double;
    return in_double == Verdict::Yes;
  }
  if (counters != nullptr) ++counters->by_exact;
  return blocks_stage<mpz_class>(G, s_G, L, point) == Verdict::Yes;
}

bool is_finite(const Vector& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

// Doubles have nothing to say about such a point either: every one of them comes here.
void require_point(const TruePoint& p, const mpz_class& w) {
  const bool is_point = is_finite(p.K) && is_finite(p.d) && is_finite(p.face[0]) && is_finite(p.face[1]) &&
                        is_finite(p.face[2]) && w != 0;
  if (!is_point) throw Error("the ray of a surface point does not meet the plane of its face");
}
void require_point(const GivenPoint&, const mpz_class&) {}  // w is the square of the normal

// X / w in world units: X and w carry one factor 2^149 less in w, since P - L has degree 1.
template <class Point>
DVector exact_offset(const Point& point, const Vector& L) {
  const Target<mpz_class> t = target<mpz_class>(point, L);
  require_point(point, t.w);
  const auto quotient = [&](const mpz_class& x) {
    mpq_class q(x, mpz_class(t.w << kFloatExponentShift));
    q.canonicalize();
    return q.get_d();
  };
  return {quotient(t.X.x), quotient(t.X.y), quotient(t.X.z)};
}

// Whether the three components are known to within kDirectionError of their length.
bool is_sharp(const Tracked& x, const Tracked& y, const Tracked& z) {
  const double length = std::sqrt(x.value * x.value + y.value * y.value + z.value * z.value);
  const double error = (x.error + y.error + z.error) * (1 + Tracked::kInflation);
  return error <= 0.5 * kDirectionError * length && length > 0x1p-400 && length < 0x1p400;
}

}  // namespace

bool is_degenerate(const Vector& a, const Vector& b, const Vector& c) {
  const Triangle f{a, b, c};
  const Vec3<Tracked> n = normal<Tracked>(f);
  const int x = n.x.sign(), y = n.y.sign(), z = n.z.sign();
  for (int sign : {x, y, z}) {
    if (sign == 1 || sign == -1) return false;
  }
  if (x == 0 && y == 0 && z == 0) return true;
  const Vec3<mpz_class> e = normal<mpz_class>(f);
  return e.x == 0 && e.y == 0 && e.z == 0;
}

int side(const Triangle& face, const Vector& O, Counters* counters) {
  return staged_sign([&]<class T>(T) { return T(determinant<T>(face, normal<T>(face), O)); }, counters);
}

Covering covers(const Triangle& face, int s, const Vector& O, const Vector& d, Counters* counters) {
  if (s == 0 || (d.x == 0 && d.y == 0 && d.z == 0)) return {};
  bool strictly_inside = true;
  const Conjunction in_double = covers_stage<Tracked>(face, s, O, vec<Tracked>(d), &strictly_inside);
  if (in_double.verdict != Verdict::Unknown) {
    if (counters != nullptr) ++counters->by_double;
    const bool hit = in_double.verdict == Verdict::Yes;
    return {hit, hit && strictly_inside};
  }
  if (counters != nullptr) ++counters->by_exact;
  strictly_inside = true;
  const Conjunction exact = covers_stage<mpz_class>(face, s, O, vec<mpz_class>(d), &strictly_inside);
  const bool hit = exact.verdict == Verdict::Yes;
  return {hit, hit && strictly_inside};
}

int compare_depth(const Triangle& face1, int s1, const Triangle& face2, int s2, const Vector& O, const Vector& d,
                  Counters* counters) {
  const auto expression = [&]<class T>(T) {
    const Vec3<T> n1 = normal<T>(face1), n2 = normal<T>(face2), dv = vec<T>(d);
    return T(T(determinant<T>(face1, n1, O) * dot(n2, dv)) - T(determinant<T>(face2, n2, O) * dot(n1, dv)));
  };
  return s1 * s2 * staged_sign(expression, counters);
}

bool blocks(const Triangle& G, int s_G, const Vector& L, const TruePoint& point, Counters* counters) {
  return blocks_staged(G, s_G, L, point, counters);
}

bool blocks(const Triangle& G, int s_G, const Vector& L, const GivenPoint& point, Counters* counters) {
  return blocks_staged(G, s_G, L, point, counters);
}

Tracked ray_parameter(const TruePoint& point) {
  const Vec3<Tracked> n = normal<Tracked>(point.face);
  const Tracked w = dot(n, vec<Tracked>(point.d)), delta = determinant<Tracked>(point.face, n, point.K);
  const double t = delta.value / w.value;
  // |t - true| <= (|delta error| + |t| |w error|) / (|w| - |w error|), and one rounding.
  const double slack = std::fabs(w.value) - w.error;
  if (!(slack > 0)) return {t, HUGE_VAL};
  return {t, (delta.error + std::fabs(t) * w.error) / slack * (1 + Tracked::kInflation) +
                 std::fabs(t) * Tracked::kHalfUlp + Tracked::kUnderflow};
}

double sharp_ray_parameter(const TruePoint& point, const Tracked& t) {
  if (t.error < 0x1p-30 * t.value) return t.value;  // false if both are infinite: a slope rounded to 0
  const Vec3<mpz_class> n = normal<mpz_class>(point.face);
  mpq_class exact(determinant<mpz_class>(point.face, n, point.K), dot(n, vec<mpz_class>(point.d)));
  exact.canonicalize();
  return exact.get_d();
}

DVector offset_from(const Vector& L, const TruePoint& point, const Tracked& t) {
  const Vec3<Tracked> D = vec<Tracked>(point.K, L) + t * vec<Tracked>(point.d);
  if (is_sharp(D.x, D.y, D.z)) return {D.x.value, D.y.value, D.z.value};
  return exact_offset(point, L);
}

DVector offset_from(const Vector& L, const GivenPoint& point) {
  if (point.on_face == nullptr) {
    return {double(point.P.x) - double(L.x), double(point.P.y) - double(L.y), double(point.P.z) - double(L.z)};
  }
  return exact_offset(point, L);
}

}  // namespace facemap
