#include "visibility/ray_lists.h"

#include <cmath>

#include "map/light_projection.h"
#include "map/map_faces.h"
#include "map/raster_size.h"
#include "math/elementary.h"

namespace facemap {
namespace {

constexpr std::size_t kSides = 6;  // of a cube: +x, -x, +y, -y, +z, -z

constexpr std::size_t kCell = 8;  // texels a side

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
                   bool keep_all, const Executor& executor)
    : origin_(origin) {
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
  cell_columns_ = static_cast<std::size_t>(maps_[0]->width()) / kCell + 1;
  cell_rows_ = static_cast<std::size_t>(maps_[0]->height()) / kCell + 1;
}

// Whichever for what is not finite: it has no texel anywhere.
std::size_t RayLists::map_number(const DVector& direction) const { return maps_.size() == 1 ? 0 : side_of(direction); }

std::uint32_t RayLists::cell_of(const DVector& direction) const {
  const std::size_t map = map_number(direction);
  const std::optional<FaceMap::Texel> texel = maps_[map]->texel_of(direction);
  if (!texel) return 0;
  const std::size_t row = map * cell_rows_ + static_cast<std::size_t>(texel->y) / kCell;
  return static_cast<std::uint32_t>(row * cell_columns_ + static_cast<std::size_t>(texel->x) / kCell);
}

Camera::Hit RayLists::nearest(const Vector& direction) const { return map_of(DVector(direction)).nearest(direction); }

std::optional<FaceId> RayLists::first_blocker(const Vector& point, std::uint32_t skip) const {
  return map_of(DVector(point) - DVector(origin_)).first_blocker(point, skip);
}

void RayLists::meet_all(const Vector& direction, std::vector<Meeting>& meetings) const {
  map_of(DVector(direction)).meet_all(direction, meetings);
}

int RayLists::count_hits(const Vector& direction) const { return map_of(DVector(direction)).count_hits(direction); }

std::size_t RayLists::memory_bytes() const {
  std::size_t bytes = 0;
  for (const auto& map : maps_) bytes += map->list_bytes();
  return bytes;
}

}  // namespace facemap
