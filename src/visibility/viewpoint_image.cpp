#include <facemap/error.h>
#include <facemap/hit_color.h>
#include <facemap/projection.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "map/light_projection.h"
#include "simd/floating_point_mode.h"
#include "visibility/pieces.h"
#include "visibility/viewpoint_parts.h"

namespace facemap {
namespace {

constexpr std::size_t kPiece = 1024;  // pixels

constexpr int kNoDirection = -1;

// The rays through the centres of pixels.
class PixelRays {
 public:
  PixelRays(const SpaceVector& frame, const Viewpoint::ImageOptions& options)
      : frame_(frame), projection_(ProjectionKind::Surface, options.field_angle, options.width, options.height) {}

  /// The zero vector where there is none.
  Vector direction(std::size_t pixel) const {
    const auto width = static_cast<std::size_t>(projection_.width());
    const MapPoint centre(static_cast<double>(pixel % width) + 0.5, static_cast<double>(pixel / width) + 0.5);
    if (!projection_.has_direction(centre)) return Vector(0);
    return Vector(frame_.world_from_local(projection_.local_from_map(centre)));
  }

 private:
  SpaceVector frame_;
  Projection projection_;
};

SpaceVector frame_of(const Scene& scene, const Vector& origin, const Vector& sight) {
  if (!std::isfinite(sight.x) || !std::isfinite(sight.y) || !std::isfinite(sight.z)) {
    throw Error("the sight of a viewpoint's picture is not finite");
  }
  return SpaceVector::looking_along(origin, sight == Vector(0) ? sight_of_light(scene, origin) : DVector(sight));
}

}  // namespace

Image Viewpoint::image(const ImageOptions& options, const Progress& progress) const {
  const FloatingPointMode mode;
  const PixelRays rays(frame_of(kept_->scene, kept_->origin, options.sight), options);
  const RayLists& lists = kept_->whole_lists();
  Image image;
  image.width = options.width;
  image.height = options.height;
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  image.ids.assign(pixels, kNoFace);
  image.depths.assign(pixels, std::numeric_limits<float>::infinity());
  std::vector<int> hits(pixels, kNoDirection);
  for_pieces(kept_->executor, pixels, kPiece, progress, [&](std::size_t first, std::size_t last, std::size_t) {
    for (std::size_t i = first; i < last; ++i) {
      const Vector direction = rays.direction(i);
      if (direction == Vector(0)) continue;
      const RayLists::Place place = lists.place_of(DVector(direction));
      const Camera::Hit nearest = lists.nearest(place, direction);
      image.ids[i] = nearest.face;
      image.depths[i] = nearest.depth;
      hits[i] = lists.count_hits(place, direction);
    }
  });
  const int most = *std::max_element(hits.begin(), hits.end());
  image.pixels.reserve(pixels);
  for (const int count : hits) {
    image.pixels.push_back(count == kNoDirection ? no_direction_color() : hit_color(count, most));
  }
  return image;
}

}  // namespace facemap
