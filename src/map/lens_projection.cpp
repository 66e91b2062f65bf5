#include <memory>

#include "map/lens_model.h"
#include "math/elementary.h"

namespace facemap {
namespace {

LensKind kind_of(const Projection& projection) {
  return projection.kind() == ProjectionKind::Surface ? LensKind::Surface : LensKind::Plane;
}

// The two projections of the paper: see Projection, which is where they and their bounds stand.
class ProjectionLens final : public LensModel {
 public:
  explicit ProjectionLens(const Projection& projection)
      : LensModel(kind_of(projection), projection.width(), projection.height()), projection_(projection) {}

  std::optional<DVector> direction(const MapPoint& place) const override {
    if (!projection_.has_direction(place)) return std::nullopt;
    return projection_.local_from_map(place);
  }

  std::optional<MapPoint> map_point(const DVector& local) const override {
    if (!projection_.is_mapped(local)) return std::nullopt;
    return projection_.map_from_local(local);
  }

  double largest_angle() const override { return elementary::kPi / (kind() == LensKind::Surface ? 1 : 2); }
  double pixel_angle(const MapPoint&, const MapPoint&) const override { return projection_.texel_angle(); }
  double angle_error() const override { return Projection::kMapError; }
  const Projection* projection() const override { return &projection_; }

 private:
  Projection projection_;
};

}  // namespace

LensModelPointer projection_lens(const Projection& projection) {
  return std::make_shared<const ProjectionLens>(projection);
}

}  // namespace facemap
