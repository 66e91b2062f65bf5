#include <facemap/view_place.h>

#include <algorithm>
#include <cmath>

#include "math/dvector.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

/// Whether two directions are so nearly parallel that float32 cannot tell which way is right.
bool is_nearly_parallel(const DVector& a, const DVector& b) {
  constexpr double kSine = 1e-6;  // about 8 units in the last place of float32
  const DVector sine = cross(a, b);
  return dot(sine, sine) <= kSine * kSine * dot(a, a) * dot(b, b);
}

}  // namespace

// It stands at -R^T t.
ViewPlace ViewPlace::of_opencv(const std::array<std::array<double, 4>, 3>& m) {
  const FloatingPointMode mode;
  Vector at(0);
  for (int i = 0; i < 3; ++i) {
    at[i] = static_cast<float>(-(m[0][i] * m[0][3] + m[1][i] * m[1][3] + m[2][i] * m[2][3]));
  }
  // Far away, so that rounding the point to float32 turns the sight by no more than 2^-23.
  const double far_away = 64.0 * std::max({std::fabs(at.x), std::fabs(at.y), std::fabs(at.z), 1.0f});
  const Vector look_at(DVector(at) + DVector(m[2][0], m[2][1], m[2][2]) * far_away);
  return {at, look_at, Vector(DVector(-m[1][0], -m[1][1], -m[1][2])), std::nullopt};
}

View complete_view(const BoundingBall& ball, const Vector& world_up, const ViewPlace& place, const View& lens) {
  const FloatingPointMode mode;
  View view = lens;
  view.up = place.up.value_or(world_up);
  const Vector centre(ball.centre);
  const View made_up = make_up_view(ball, world_up, view);
  view.height = place.height.value_or(static_cast<float>(made_up.height));  // as it will be printed
  if (place.position) {
    view.position = *place.position;
    view.look_at = place.look_at.value_or(centre);
    if (!place.look_at && view.position == centre) view.look_at = centre + Vector(0, 0, -1);
  } else {
    view.look_at = place.look_at.value_or(made_up.look_at);
    view.position = made_up.position + (view.look_at - made_up.look_at);
  }
  if (!place.up && is_nearly_parallel(DVector(view.look_at - view.position), DVector(view.up))) {
    view.up = Vector(view.up.z, view.up.x, view.up.y);
  }
  return view;
}

}  // namespace facemap
