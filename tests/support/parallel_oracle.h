#pragma once

#include <facemap/mesh.h>
#include <facemap/point_light.h>
#include <facemap/surface_point.h>

#include <array>
#include <vector>

#include "support/big_numbers.h"
#include "support/oracle.h"

/// The referee for parallel light and parallel rays. It knows no normal: faces and points are seen along d, as flat
/// triangles and points, where three oriented areas e_i say whether P is within the face, and as weights of the
/// corners, which point of the face P lies on. In doubles with a bound of its own where that is enough, else in GMP.
namespace oracle {

/// A point X / w, w > 0, in units of 2^-149, and rounded: to 2^-50 relative, component by component; NaN where doubles
/// may overflow or underflow.
struct Place {
  BigVector X;
  mpz_class w;
  std::array<double, 3> rounded;
};

Place place_of(const Vector& P);
/// Where the ray meets the plane of its face.
Place place_of(const SurfacePoint& point);
/// The orthogonal projection of P onto the plane of a face.
Place place_on(const std::array<Vector, 3>& face, const Vector& P);

/// A face, as parallel light along d meets it.
class ParallelFace {
 public:
  ParallelFace(const std::array<Vector, 3>& corners, const Vector& d);

  /// -1 if it is turned towards where the light comes from, 1 if away, 0 if edge-on.
  int side() const { return side_; }

  /// How the line through P along d meets the face.
  struct Meeting {
    bool is_met = false;  ///< edges and vertices count
    bool strictly_inside = false;
    int where = 0;  ///< if met: -1 before P, where the light comes from; 0 in P; 1 beyond
  };
  Meeting meet(const Place& P, bool use_doubles = true) const;

  /// Sign of the difference of the places, along d, in which the line through P meets two faces.
  static int compare(const ParallelFace& f, const ParallelFace& g, const Place& P);

  /// Whether P is farther than the tolerance from the face's plane.
  static bool is_far(const std::array<Vector, 3>& corners, const Vector& P, float tolerance);

 private:
  struct Weights {
    std::array<mpz_class, 3> e;  // times side_ d_k, so that all are at least 0 for a point within
    mpz_class sum, height;       // height / sum = w d . (G - P), G the point of the face
  };
  Weights weigh(const Place& P) const;
  bool meet_in_doubles(const Place& P, Meeting* meeting) const;  // false: nothing is sure

  std::array<Vector, 3> corners_;
  Vector d_;
  int axis_;  // k: the axis along which d is longest, where it is not 0
  int side_, turn_;
};

/// A mesh in parallel light along d, or seen by parallel rays along it.
class ParallelView {
 public:
  /// The oracle must outlive it.
  ParallelView(const Oracle& oracle, const Vector& d);

  /// By id; faces of an oracle that are not kept are met by nothing.
  int side(FaceId face) const;

  Hit nearest(const Vector& ray_origin) const;
  /// Without regard to holes.
  bool is_blocked(const Place& P, FaceId skipped = kNoFace) const;
  /// With facing: the camera and the light on the same side of the face.
  bool is_lit(const SurfacePoint& point) const;
  bool is_lit(const Vector& P, const facemap::PointLight::On& on) const;

 private:
  struct KeptFace {
    FaceId id;
    std::array<Vector, 3> corners;
    ParallelFace face;
  };
  bool is_there(FaceId face, const Vector& P) const;

  const Oracle* oracle_;
  Vector d_;
  std::vector<KeptFace> faces_;
};

}  // namespace oracle
