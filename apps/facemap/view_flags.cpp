#include "view_flags.h"

#include <glm/geometric.hpp>

#include "text_values.h"

namespace facemap::program {
namespace {

/// Whether two directions are so nearly parallel that float32 cannot tell which way is right.
bool is_nearly_parallel(const Vector& a, const Vector& b) {
  constexpr double kSine = 1e-6;  // about 8 units in the last place of float32
  const DVector cross = glm::cross(DVector(a), DVector(b));
  return glm::dot(cross, cross) <= kSine * kSine * glm::dot(DVector(a), DVector(a)) * glm::dot(DVector(b), DVector(b));
}

}  // namespace

View complete_view(const BoundingBall& ball, const Vector& up, const WantedView& wanted) {
  View view;
  view.field_angle = wanted.field_angle;
  view.projection = wanted.projection;
  set_lens(wanted.lens, wanted.size, view);
  view.up = wanted.up.value_or(up);
  const Vector centre(ball.centre);
  const View made_up = make_up_view(ball, up, view);
  view.height = wanted.lens.height.value_or(static_cast<float>(made_up.height));  // as it will be printed
  if (wanted.camera) {
    view.position = *wanted.camera;
    view.look_at = wanted.look_at.value_or(centre);
    if (!wanted.look_at && view.position == centre) view.look_at = centre + Vector(0, 0, -1);
  } else {
    view.look_at = wanted.look_at.value_or(made_up.look_at);
    view.position = made_up.position + (view.look_at - made_up.look_at);
  }
  if (!wanted.up && is_nearly_parallel(view.look_at - view.position, view.up)) view.up = Vector(up.z, up.x, up.y);
  return view;
}

std::string flags_of(const View& view) {
  std::string flags =
      "--camera " + text_of(view.position) + " --look-at " + text_of(view.look_at) + " --up " + text_of(view.up);
  if (view.is_parallel)
    return flags + " --lens orthographic --ortho-height " + text_of(static_cast<float>(view.height));
  if (view.lens) return flags;  // its own flags are given
  flags += " --field-angle " + degrees_text(view.field_angle);
  if (view.projection == ProjectionKind::Plane) flags += " --projection plane";
  return flags;
}

}  // namespace facemap::program
