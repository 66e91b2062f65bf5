#pragma once

#include <facemap/point_light.h>

#include <cstdint>

#include "map/map_faces.h"

namespace facemap {

/// A PointLight whose points lie on faces only up to rounding, and may have a tolerance besides: what Viewpoint's
/// targets are. Const members may be called by several threads together.
class PointLists : public PointLight {
 public:
  PointLists(const MapFaces& faces, const Vector& position) : PointLight(faces, position, Options()) {}

  /// Whether some face but `own` (kNoFace: none) that is farther than `tolerance` from the point stands strictly
  /// between. Exact.
  bool hides(const Vector& point, FaceId own, float tolerance) const;

 private:
  template <class Predicate>
  bool any_of_list(const Texel& texel, const DVector& offset, std::uint32_t own, float tolerance,
                   const Predicate& blocks) const;
  template <class Predicate>
  bool any_of_cut_outs(const Texel& texel, const Vector& point, std::uint32_t own, const Predicate& blocks) const;
};

}  // namespace facemap
