#include "visibility/ray_lists.h"

#include <cmath>

#include "map/light_projection.h"
#include "map/map_faces.h"
#include "map/raster_size.h"
#include "math/elementary.h"

namespace facemap {
namespace {

constexpr std::size_t kSides = 6;  // of a cube: +x, -x, +y, -y, +z, -z

// Share by which the raster of a side is wider than the side: no rounding leads out of it.
constexpr double kRim = 1e-3;

// A quarter of the texels that a surface would have, a side: one and a half times as many in all.
int texels_of_side(std::size_t faces) { return texels_for(faces) / 2; }

SpaceVector frame_of_side(const Vector& origin, std::size_t side) {
  DVector sight(0);
  sight[static_cast<int>(side / 2)] = side % 2 == 0 ? 1 : -1;
  return SpaceVector::looking_along(origin, sight);
}

std::size_t side_of(const DVector& d) {
  const double x = std::fabs(d.x), y = std::fabs(d.y), z = std::fabs(d.z);
  if (x >= y && x >= z) return d.x > 0 ? 0 : 1;
  if (y >= z) return d.y > 0 ? 2 : 3;
  return d.z > 0 ? 4 : 5;
}

}  // namespace

RayLists::RayLists(const MapFaces& faces, const Vector& origin, const std::shared_ptr<const FacePlanesTable>& planes,
                   bool keep_all, const Executor& executor) {
  const SpaceVector frame = SpaceVector::looking_along(origin, sight_of_light(faces.all(), origin));
  const Projection before = light_projection(faces.all(), frame, {});
  if (before.kind() == ProjectionKind::Plane) {
    maps_.push_back(std::make_unique<const RayMap>(faces, frame, before, planes, keep_all));
    count_cells();
    return;
  }
  const int texels = texels_of_side(faces.all().kept_faces().size());
  const Projection side(ProjectionKind::Plane, 2 * elementary::atan2(1 + kRim, 1), texels, texels);
  maps_.resize(kSides);
  executor.for_each(kSides, [&](std::size_t i, int) {
    maps_[i] = std::make_unique<const RayMap>(faces, frame_of_side(origin, i), side, planes, keep_all);
  });
  count_cells();
}

void RayLists::count_cells() {
  cell_columns_ = static_cast<Place>(maps_[0]->width()) / kCell + 1;
  cell_rows_ = static_cast<Place>(maps_[0]->height()) / kCell + 1;
}

// By map, row and column of cells, row and column in the cell.
RayLists::Place RayLists::place_of(const DVector& direction) const {
  const std::size_t map = maps_.size() == 1 ? 0 : side_of(direction);
  const std::optional<FaceMap::Texel> texel = maps_[map]->texel_of(direction);
  if (!texel) return kNowhere;
  const auto x = static_cast<Place>(texel->x), y = static_cast<Place>(texel->y);
  const Place row = static_cast<Place>(map) * cell_rows_ + y / kCell;
  return (row * cell_columns_ + x / kCell) * kCellTexels + y % kCell * kCell + x % kCell;
}

RayLists::Spot RayLists::spot_of(Place place) const {
  const Place cell = place / kCellTexels, row = cell / cell_columns_, within = place % kCellTexels;
  const Place x = cell % cell_columns_ * kCell + within % kCell, y = row % cell_rows_ * kCell + within / kCell;
  return {*maps_[row / cell_rows_], {static_cast<int>(x), static_cast<int>(y)}};
}

Camera::Hit RayLists::nearest(Place place, const Vector& direction) const {
  if (place == kNowhere) return {};
  const Spot spot = spot_of(place);
  return spot.map.nearest_in(spot.texel, direction);
}

std::optional<FaceId> RayLists::first_blocker(Place place, const Vector& point, std::uint32_t skip) const {
  if (place == kNowhere) return kNoFace;
  const Spot spot = spot_of(place);
  return spot.map.first_blocker(spot.texel, point, skip);
}

void RayLists::meet_all(Place place, const Vector& direction, std::vector<Meeting>& meetings) const {
  if (place == kNowhere) return;
  const Spot spot = spot_of(place);
  spot.map.meet_all(spot.texel, direction, meetings);
}

int RayLists::count_hits(Place place, const Vector& direction) const {
  return place == kNowhere ? 0 : spot_of(place).map.count_hits(direction);
}

std::size_t RayLists::memory_bytes() const {
  std::size_t bytes = 0;
  for (const auto& map : maps_) bytes += map->list_bytes();
  return bytes;
}

}  // namespace facemap
