#pragma once

#include <facemap/projection.h>
#include <facemap/scene.h>
#include <facemap/space_vector.h>

#include <cstdint>
#include <vector>

#include "map/cover.h"
#include "map/face_planes.h"
#include "map/texel_box.h"

namespace facemap {

/// The builder `cover` for plane projections, where a face well in front of the map is a PlaneFace.
class PlaneCover {
 public:
  PlaneCover(const Scene& scene, const SpaceVector& frame, const Projection& projection, const FacePlanesTable& planes,
             Coverage& out);

  /// How many faces are not surely outside of the raster.
  std::size_t count_faces() const;

  /// Adds to the cuts or to the entries what face `id`, which has a side, gives to them. False if it is neither well
  /// in front of the map nor surely outside of it.
  bool add(std::uint32_t id, Pass pass);

 private:
  struct Image;

  bool is_outside(std::uint32_t id) const;
  void project_vertices();
  std::uint8_t sides_outside(const DVector& local) const;
  void cut(std::uint32_t id, const Image& image);
  void enter(std::uint32_t id, const Image& image);
  std::size_t row_of(int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(projection_.width());
  }

  const Scene& scene_;
  const SpaceVector& frame_;
  const Projection& projection_;
  const FacePlanesTable& planes_;
  Coverage& out_;
  double margin_;                      // of map points, texels
  double edge_x_, edge_y_;             // tangents of angles from the axis, surely outside of the raster
  std::vector<MapPoint> points_;       // of vertices; infinite for those not well in front
  std::vector<std::uint8_t> outside_;  // of vertices: one bit a plane through O that the raster lies before
};

}  // namespace facemap
