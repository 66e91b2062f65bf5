#pragma once

#include <cstdint>

#include "map/face_planes.h"
#include "math/dvector.h"

namespace facemap {

/// A face about a light, ready to be held against points in doubles.
struct NearFace {
  /// A plane through the light, or the plane of the face: its normal, turned inwards or away from the light, and by how
  /// much the normal and the doubles' dot product with an offset D are off, over |D|_1.
  struct Plane {
    DVector normal;
    double error;
  };

  std::uint32_t face;
  int side;
  Plane edges[3];
  Plane plane;
  double offset, offset_error;  ///< of the plane: a point is beyond it where normal . D > offset
};

/// `side` is that towards the light, not 0.
NearFace near_face(std::uint32_t face, int side, const Triangle& corners, const Vector& light);

/// 1: the face surely blocks the point at D from the light, which is within `error` in each coordinate; -1: it surely
/// does not; 0: open.
int verdict_on(const NearFace& face, const DVector& D, double error);

}  // namespace facemap
