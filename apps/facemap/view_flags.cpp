#include "view_flags.h"

#include <facemap/view_place.h>

#include "text_values.h"

namespace facemap::program {
View complete_view(const BoundingBall& ball, const Vector& up, const WantedView& wanted) {
  View lens;
  lens.field_angle = wanted.field_angle;
  lens.projection = wanted.projection;
  set_lens(wanted.lens, wanted.size, lens);
  return facemap::complete_view(ball, up, {wanted.camera, wanted.look_at, wanted.up, wanted.lens.height}, lens);
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
