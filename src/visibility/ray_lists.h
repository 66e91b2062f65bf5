#pragma once

#include <cstddef>
#include <cstdint>
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

  /// Directions by where they lie, below cells(): those of one cell have lists of the same faces mostly. Any for a
  /// direction without a list.
  std::uint32_t cell_of(const DVector& direction) const;
  std::size_t cells() const { return maps_.size() * cell_rows_ * cell_columns_; }

  /// Bytes of the lists, the planes not counted.
  std::size_t memory_bytes() const;

 private:
  void count_cells();
  std::size_t map_number(const DVector& direction) const;
  const RayMap& map_of(const DVector& direction) const { return *maps_[map_number(direction)]; }

  Vector origin_;
  std::vector<std::unique_ptr<const RayMap>> maps_;
  std::size_t cell_columns_ = 0, cell_rows_ = 0;  // of one map
};

}  // namespace facemap
