#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "parallel/executor.h"
#include "visibility/ray_map.h"

namespace facemap {

/// The lists of all directions in which there are faces: one plane for an origin that has the scene before it, else the
/// six sides of a cube about it. Departs: the paper's maps are surfaces, round the whole of a point; on planes edges
/// stay straight, and a map is made in a small part of the time.
class RayLists {
 public:
  RayLists(const MapFaces& faces, const Vector& origin, const std::shared_ptr<const FacePlanesTable>& planes,
           bool keep_all, const Executor& executor);

  /// As Camera::nearest.
  Camera::Hit nearest(const Vector& direction) const;

  /// As RayMap has them.
  std::optional<FaceId> first_blocker(const Vector& point, std::uint32_t skip) const;
  void meet_all(const Vector& direction, std::vector<Meeting>& meetings) const;
  int count_hits(const Vector& direction) const;

  /// Bytes of the lists, the planes not counted.
  std::size_t memory_bytes() const;

 private:
  const RayMap& map_of(const DVector& direction) const;

  Vector origin_;
  std::vector<std::unique_ptr<const RayMap>> maps_;
};

}  // namespace facemap
