#include "frames.h"

#include <facemap/error.h>
#include <facemap/space_vector.h>
#include <facemap/turntable.h>
#include <facemap/view_place.h>

#include <algorithm>

#include "usage_error.h"

namespace facemap::program {
namespace {

constexpr double kHalfTurn = 3.14159265358979323846;

/// The value of frame `i` from a list that has none, one or one a frame.
template <typename Value>
std::optional<Value> value_of(const std::vector<Value>& values, std::size_t i) {
  if (values.empty()) return std::nullopt;
  return values.size() == 1 ? values[0] : values[i];
}

void check_number(const char* flag, std::size_t given, std::size_t cameras) {
  if (given <= 1 || given == cameras) return;
  std::string reason = std::string(flag) + " is given " + std::to_string(given) + " times, --camera ";
  reason += cameras == 0 ? "not at all" : cameras == 1 ? "once" : std::to_string(cameras) + " times";
  throw UsageError(reason + "; give it once for all cameras or once for each");
}

void check_lens(const WantedFrames& wanted) {
  check(wanted.lens);
  if (wanted.lens.name && wanted.projection) throw UsageError("--projection and --lens both name the lens; give one");
  if (!wanted.lens.has_field_angle() && !wanted.field_angles.empty()) {
    throw UsageError("--field-angle is for the surface and plane lenses");
  }
  const bool is_plane = wanted.lens.name ? wanted.lens.is(LensName::Plane) : wanted.projection == ProjectionKind::Plane;
  for (const double angle : wanted.field_angles) {
    if (is_plane && angle >= kHalfTurn) throw UsageError("--field-angle: a plane picture shows less than 180 degrees");
  }
  if (!wanted.lens.pose) return;
  if (!wanted.cameras.empty() || !wanted.look_ats.empty() || !wanted.ups.empty()) {
    throw UsageError("--opencv-pose takes the place of --camera, --look-at and --up; give one or the other");
  }
  if (wanted.turntable > 0) throw UsageError("--turntable needs a point to look at, which --opencv-pose has not");
}

/// A camera must look somewhere, and know which way is up.
void check_sight(const View& view) {
  if (view.position == view.look_at) throw UsageError("--look-at: the camera stands at the point that it looks at");
  try {
    SpaceVector::looking_at(view.position, view.look_at, view.up);
  } catch (const Error& error) {
    throw UsageError(std::string("--up: ") + error.what());
  }
}

}  // namespace

std::vector<WantedView> WantedFrames::each() const {
  check_number("--look-at", look_ats.size(), cameras.size());
  check_number("--up", ups.size(), cameras.size());
  check_number("--field-angle", field_angles.size(), cameras.size());
  if (turntable > 0 && cameras.size() > 1)
    throw UsageError("--turntable turns one camera; --camera is given more often");
  check_lens(*this);
  std::vector<WantedView> views(std::max<std::size_t>(1, cameras.size()));
  for (std::size_t i = 0; i < views.size(); ++i) {
    views[i].camera = value_of(cameras, i);
    views[i].look_at = value_of(look_ats, i);
    views[i].up = value_of(ups, i);
    views[i].field_angle = value_of(field_angles, i).value_or(View().field_angle);
    views[i].projection = projection.value_or(ProjectionKind::Surface);
    views[i].lens = lens;
  }
  if (lens.pose) {
    const auto place = ViewPlace::of_opencv(*lens.pose);
    views[0].camera = place.position;
    views[0].look_at = place.look_at;
    views[0].up = place.up;
  }
  return views;
}

std::size_t WantedFrames::count() const {
  const std::size_t views = each().size();
  return turntable > 0 ? static_cast<std::size_t>(turntable) : views;
}

FrameRange WantedFrames::selected(std::size_t all) const {
  if (!range) return {0, all - 1};
  if (range->last < all) return *range;
  throw UsageError("--frames " + std::to_string(range->last) + ": the pictures are numbered 0 to " +
                   std::to_string(all - 1));
}

std::vector<View> complete_views(const BoundingBall& ball, const Vector& up, const std::vector<WantedView>& wanted,
                                 int turntable, const Size& size) {
  if (turntable > 0 && wanted.size() > 1)
    throw UsageError("--turntable turns one camera, and there are " + std::to_string(wanted.size()));
  std::vector<View> views;
  for (WantedView view : wanted) {
    view.size = size;
    check_height(view.lens);
    views.push_back(complete_view(ball, up, view));
    check_sight(views.back());
  }
  return turntable > 0 ? facemap::turntable(views[0], turntable) : views;
}

}  // namespace facemap::program
