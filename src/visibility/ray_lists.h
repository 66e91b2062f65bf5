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

  /// Where a direction has its list: those of neighbours have many faces in common. Places fall into cells of eight by
  /// eight texels, numbered one after the other.
  using Place = std::uint32_t;
  static constexpr Place kNowhere = 0xffffffffu;  ///< of a direction in which there are no faces, or that is none
  Place place_of(const DVector& direction) const;
  static std::size_t cell_of(Place place) { return place / kCellTexels; }
  std::size_t cells() const { return maps_.size() * cell_rows_ * cell_columns_; }

  /// As Camera::nearest, for a direction whose place is known.
  Camera::Hit nearest(Place place, const Vector& direction) const;

  /// As RayMap has them.
  std::optional<FaceId> first_blocker(Place place, const Vector& point, std::uint32_t skip) const;
  void meet_all(Place place, const Vector& direction, std::vector<Meeting>& meetings) const;
  int count_hits(Place place, const Vector& direction) const;

  /// Bytes of the lists, the planes not counted.
  std::size_t memory_bytes() const;

 private:
  static constexpr Place kCell = 8, kCellTexels = kCell * kCell;

  struct Spot {
    const RayMap& map;
    FaceMap::Texel texel;
  };
  Spot spot_of(Place place) const;
  void count_cells();

  std::vector<std::unique_ptr<const RayMap>> maps_;
  Place cell_columns_ = 0, cell_rows_ = 0;  // of one map
};

}  // namespace facemap
