#include "math/parallel_signs.h"

#include "math/exact_stage.h"
#include "math/expressions.h"
#include "math/numbers.h"
#include "math/plain_parallel_signs.h"

namespace facemap {
namespace {

// Strictly beyond G's plane, and on the inner side of its edges as seen along d. `s` is that of G times the sign of the
// point's w.
template <class Numbers, class Point>
bool is_behind_along(const Numbers& numbers, const Triangle& G, int s, const Vector& d, const Point& point) {
  if (s * dot(normal(numbers, G), point.from(numbers, G[0])).sign() <= 0) return false;
  const auto direction = numbers.direction(d);
  for (int i = 0; i < 3; ++i) {
    if (s * edge_along(numbers, G[i], G[(i + 1) % 3], point, direction).sign() < 0) return false;
  }
  return true;
}

// A camera's direction and the light's are measured in one unit.
ExponentRange directions_of(const TruePoint& point, const Vector& d) { return ExponentRange::of(point.d, d); }
ExponentRange directions_of(const GivenPoint&, const Vector& d) { return ExponentRange::of(d); }

template <class Point>
bool blocks_along_staged(const Triangle& G, int s_G, const Vector& d, const Point& point, Counters* counters) {
  if (s_G == 0) return false;
  const Verdict in_double = plain::blocks_along(G, s_G, d, point);
  count_stage(in_double != Verdict::Unknown, counters);
  if (in_double != Verdict::Unknown) return in_double == Verdict::Yes;
  // G[0] stands for the light, which has no place.
  return in_integers(lengths_of(G, point, G[0]), directions_of(point, d), [&](const auto& numbers) {
    return blocks_rational(numbers, G, s_G, point,
                           [&](const auto& P, int s) { return is_behind_along(numbers, G, s, d, P); });
  });
}

}  // namespace

int side_along(const Triangle& face, const Vector& d, Counters* counters) {
  const int in_double = plain::side_along(face, d);
  count_stage(in_double != kUnknownSign, counters);
  if (in_double != kUnknownSign) return in_double;
  return in_integers(ExponentRange::of(face[0], face[1], face[2]), ExponentRange::of(d),
                     [&](const auto& numbers) { return dot(normal(numbers, face), numbers.direction(d)).sign(); });
}

Covering covers_along(const Triangle& face, int s, const Vector& O, const Vector& d, Counters* counters) {
  if (s == 0) return {};
  const Verdict in_double = plain::covers_along(face, s, O, d);
  count_stage(in_double != Verdict::Unknown, counters);
  if (in_double != Verdict::Unknown) return {in_double == Verdict::Yes, in_double == Verdict::Yes};
  return in_integers(lengths_of(face, O), ExponentRange::of(d), [&](const auto& numbers) {
    if (s * determinant(numbers, face, normal(numbers, face), O).sign() <= 0) return Covering{};
    bool strictly_inside = true;
    const bool hit = is_within_edges(numbers, face, s, O, numbers.direction(d), &strictly_inside);
    return Covering{hit, hit && strictly_inside};
  });
}

bool blocks_along(const Triangle& G, int s_G, const Vector& d, const TruePoint& point, Counters* counters) {
  return blocks_along_staged(G, s_G, d, point, counters);
}

// A corner of G lies on G's plane, which only integers would see.
bool blocks_along(const Triangle& G, int s_G, const Vector& d, const GivenPoint& point, Counters* counters) {
  const bool is_corner = point.P == G[0] || point.P == G[1] || point.P == G[2];
  if (is_corner && point.on_face == nullptr) return false;
  return blocks_along_staged(G, s_G, d, point, counters);
}

bool is_facing_along(const Triangle& face, int s_camera, const Vector& d, Counters* counters) {
  return s_camera * side_along(face, d, counters) > 0;
}

}  // namespace facemap
