#pragma once

#include <facemap/projection.h>
#include <facemap/space_vector.h>

#include "math/exact_sign.h"

namespace facemap {

/// The texels that a face's image touches and covers on a plane projection, row by row. Edges are straight there: a
/// square misses a triangle only if it lies beyond one of its edges or beside its box.
class PlaneFace {
 public:
  /// `corners`: map points, each off by at most `margin` texels in x and y, as are those of queries. `side` is the
  /// face's, not 0. Columns and rows count from the texel at `origin`, which is in the face's box.
  PlaneFace(const MapPoint (&corners)[3], int side, double margin, const MapPoint& origin);

  /// Columns of one row, both ends inside; none if first > last.
  struct Columns {
    int first, last;
  };

  /// Those of 0..last_column in whose texel some direction may hit the face.
  Columns touched(int row, int last_column) const { return columns(row, last_column, 1); }

  /// Those of which every direction hits the face.
  Columns covered(int row, int last_column) const { return columns(row, last_column, -1); }

 private:
  // A x + B y + C >= 0 inside, at the middle of the texel in column x and row y; elsewhere in it off by `reach` at
  // most.
  struct Edge {
    double A, B, C, reach;
    double negative_inverse;  // -1 / A
  };

  Columns columns(int row, int last_column, int sign) const;

  Edge edges_[3];
};

/// Upper bounds of a face's distance over texels of a plane projection that it covers, world units.
class PlaneDepth {
 public:
  PlaneDepth(const Triangle& face, int side, const SpaceVector& frame, const Projection& projection, double margin);

  double farthest(int x, int y) const;

 private:
  DVector normal_;  // unit, pointing away from the origin, local axes
  double normal_slack_, plane_distance_, farthest_corner_;
  double texel_angle_, centre_x_, centre_y_, half_texel_;
};

}  // namespace facemap
