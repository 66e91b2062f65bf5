#include "map/parallel_frame.h"

#include <facemap/error.h>

#include <algorithm>
#include <cmath>

#include "map/cover.h"
#include "map/face_planes.h"
#include "map/raster_size.h"
#include "math/dvector.h"
#include "math/power_of_two.h"

namespace facemap {
namespace {

// How far off the places of points that are asked may be, relative to the scene's reach: fractions have kPlaceError at
// 2^13 times the reach, and a picture's points, held as whole numbers of a step of 2^-29 or so, are well within.
constexpr double kAllowed = 0x1p-26;

// The raster's least size, relative to the reach: a scene that d sees edge-on still has texels far above the errors.
constexpr double kLeastSize = 0x1p-12;

// Room in front of all faces and behind them, relative to the reach. Depths are compared with a relative margin of
// Texels::kDepthMargin = 2^-18, which is 2^-21 of the reach then, and more than places are off.
constexpr double kRoom = 0x1p-3;

SpaceVector axes_of(const Scene& scene, const Vector& direction) {
  const double sum = double{direction.x} + direction.y + direction.z;
  if (!std::isfinite(sum)) throw Error("the direction of parallel light or rays is not finite");
  if (direction == Vector(0)) throw Error("the direction of parallel light or rays is zero");
  return SpaceVector::looking_along(Vector(scene.centre()), DVector(direction));
}

}  // namespace

ParallelFrame::ParallelFrame(const Scene& scene, const Vector& direction, int texels)
    : axes_(axes_of(scene, direction)),
      reach_((length(scene.centre() - DVector(origin())) + scene.bounding_radius()) * (1 + 0x1p-30)),
      scale_(inverse_power_of_two(reach_)) {
  if (!(reach_ > 0)) return;  // a scene without faces
  DVector low(HUGE_VAL), high(-HUGE_VAL);
  for (const std::uint32_t id : scene.kept_faces()) {
    for (const Vector& v : triangle_of(scene, id)) {
      const DVector p = local(DVector(v) - DVector(origin()));
      low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
  }
  if (!(low.x <= high.x)) low = high = DVector(0);
  front_ = low.z - kRoom * reach_;
  back_ = high.z + kRoom * reach_;
  allowed_ = kAllowed * reach_;
  // A rim of which no face is near the outer edge.
  const double rim = 4 * allowed_;
  const double x = std::max(high.x - low.x, kLeastSize * reach_) + 2 * rim;
  const double y = std::max(high.y - low.y, kLeastSize * reach_) + 2 * rim;
  const double stretch = std::sqrt(std::clamp(y / x, 1 / kMostOblong, kMostOblong));
  texel_ = std::max(x * stretch, y / stretch) / texels * (1 + 0x1p-40);
  width_ = std::max(1, static_cast<int>(std::ceil(x / texel_)));
  height_ = std::max(1, static_cast<int>(std::ceil(y / texel_)));
  left_ = low.x - rim;
  top_ = high.y + rim;
  margin_ = allowed_ / texel_ + kCoordinateRounding;
  extent_ = std::max({std::fabs(left_), std::fabs(left_ + width_ * texel_), std::fabs(top_),
                      std::fabs(top_ - height_ * texel_), std::fabs(front_), std::fabs(back_)}) *
            (1 + 0x1p-40);
}

ParallelFrame::Place ParallelFrame::place(const DVector& offset, double relative_error) const {
  return {local(offset), relative_error * length(offset)};
}

MapPoint ParallelFrame::map_point(const DVector& at) const { return {(at.x - left_) / texel_, (top_ - at.y) / texel_}; }

ParallelFrame::Found ParallelFrame::find(const Place& place) const {
  const MapPoint p = map_point(place.at);
  if (!(place.error <= allowed_)) {
    const double slack = place.error / texel_ * (1 + 0x1p-40) + margin_;
    const bool is_beside = p.x < -slack || p.x > width_ + slack || p.y < -slack || p.y > height_ + slack;
    return {is_beside ? Where::Nowhere : Where::Anywhere};
  }
  if (!(p.x >= 0 && p.x < width_ && p.y >= 0 && p.y < height_)) return {};
  return {Where::Texel,
          static_cast<std::uint32_t>(p.y) * static_cast<std::uint32_t>(width_) + static_cast<std::uint32_t>(p.x)};
}

}  // namespace facemap
