#pragma once

#include <facemap/mesh.h>
#include <facemap/point_light.h>
#include <facemap/surface_point.h>

#include <array>
#include <cstdint>
#include <vector>

#include "support/big_numbers.h"
#include "support/holes.h"

/// The referee: which face is nearest, whether a point is lit, by asking every face of a mesh. It has its own
/// arithmetic and its own reading of the contract and shares no code with src/; it knows no map.
///
/// Letters: O the point that looks (a camera or a light), a, b, c the corners of a face, A = a - O and so on,
/// n = (b-a) x (c-a), s = sign det(A, B, C). Exact numbers are GMP integers: every float32 times 2^149 is one.
namespace oracle {

using facemap::FaceId;
using facemap::kNoFace;
using facemap::Mesh;
using facemap::SurfacePoint;
using facemap::Vector;

/// The end of a segment from O, exactly, and rounded: P - O = X / w, w > 0, in units of 2^-149. `rounded` is
/// within 2^-50 of it, relative, component by component; NaN where doubles may overflow or underflow.
struct Target {
  BigVector X;
  mpz_class w;
  std::array<double, 3> rounded;
};

/// The face of the mesh that a ray meets first, as facemap::Camera::Hit without a depth.
struct Hit {
  FaceId face = kNoFace;
  bool strictly_inside = false;
  bool tied = false;
  int side = 0;

  friend bool operator==(const Hit&, const Hit&) = default;
};

class View;

/// A mesh, and which of its faces count: not those of zero area, not those with the same three positions as a
/// face of lower id. With holes: not those of which nothing is there; those that are cut out count whatever their
/// positions, and are no reason to leave out a solid one.
class Oracle {
 public:
  explicit Oracle(const Mesh& mesh, const Holes* holes = nullptr);

  const Mesh& mesh() const { return *mesh_; }

  /// Whether a face is there where the line from p along d meets it.
  bool is_there(FaceId face, const Holes::Point& p, const Holes::Point& d) const {
    return kind(face) != Holes::Kind::CutOut || holes_->is_there(face, p, d);
  }

  bool is_kept(FaceId face) const { return kept_[face] != 0; }
  const std::vector<FaceId>& kept_faces() const { return kept_faces_; }

  /// The mesh as seen from one point. The oracle must outlive it, and the mesh the oracle.
  View from(const Vector& origin) const;

  /// The same without any double: slow, to test the other.
  View from_by_integers(const Vector& origin) const;

  /// s: which side of the face's plane `origin` lies on.
  int side(FaceId face, const Vector& origin) const;

 private:
  Holes::Kind kind(FaceId face) const { return holes_ == nullptr ? Holes::Kind::Solid : holes_->kind(face); }

  const Mesh* mesh_;
  const Holes* holes_;
  std::vector<std::uint8_t> kept_;
  std::vector<FaceId> kept_faces_;
};

class View {
 public:
  View(const Oracle& oracle, const Vector& origin, bool use_doubles);

  const Vector& origin() const { return origin_; }

  Hit nearest(const Vector& direction) const;
  int count_hits(const Vector& direction) const;

  /// All faces that the ray meets, nearest first; of those at the same distance one turned towards O first, then the
  /// lower id.
  std::vector<FaceId> all_hits(const Vector& direction) const;

  /// The first face in that order, `skip` left out, that stands strictly between O and the point; kNoFace: none.
  FaceId first_blocker(const Vector& point, FaceId skip) const;

  /// Whether the ray along `direction` meets this one face.
  bool meets(FaceId face, const Vector& direction) const;

  /// How far along the ray `face`, which it meets, is: world units, to 2^-48 relative; NaN past the range of doubles.
  double distance(FaceId face, const Vector& direction) const;

  bool is_blocked(const SurfacePoint& point) const;
  bool is_lit(const SurfacePoint& point) const;
  bool is_lit(const Vector& point, const facemap::PointLight::On& on) const;

  /// Whether no face but `own` (kNoFace: none) that is farther than `tolerance` from the point stands strictly between.
  bool is_visible(const Vector& point, FaceId own, float tolerance) const;

  /// How many signs the doubles left to the integers so far.
  std::uint64_t exact_signs() const { return exact_signs_; }

 private:
  // A plane through O or a face's own, and the most that the computed value of n . x - offset is off by, for
  // |x| + |y| + |z| = 1 and for the offset.
  struct Plane {
    double x, y, z, error, offset, offset_error;
  };
  struct FacePlanes {
    FaceId face;
    int s;
    std::array<Plane, 3> edges;  // inward
    Plane own;                   // positive beyond
  };
  struct Meeting {
    std::size_t index;
    bool strictly_inside;
  };

  template <class Visit>
  void for_each_near(const Target& target, Visit visit) const;
  bool meets(const FacePlanes& planes, const Target& target, bool* strictly_inside) const;
  bool is_beyond(const FacePlanes& planes, const Target& target) const;
  int edge_sign(const FacePlanes& planes, int edge, const Target& target) const;
  int exact_edge_sign(const FacePlanes& planes, int edge, const Target& target) const;
  int compare_distance(const FacePlanes& f, const FacePlanes& g, const Target& target) const;
  std::vector<Meeting> all_meetings(const Vector& direction) const;
  bool comes_before(const FacePlanes& f, const FacePlanes& g, const Target& target) const;
  bool is_reached(const Target& target, const Vector& point, FaceId own, float tolerance) const;
  bool is_there_before(FaceId face, const Holes::Point& point) const;
  Target target_from(const BigVector& X, const mpz_class& w) const;
  Target target_from(const Vector& direction) const;
  Target target_of(const SurfacePoint& point) const;
  Target target_of(const Vector& point, FaceId on_face) const;
  bool is_far_from_plane(FaceId face, const Vector& point, float tolerance) const;

  const Oracle* oracle_;
  Vector origin_;
  bool use_doubles_;
  std::vector<FacePlanes> faces_;  // those with s != 0
  // A cone about each face: every X in the face's own cone has axis . X >= cosine |X|; -2: unbounded.
  std::vector<float> axis_x_, axis_y_, axis_z_, cosine_;
  mutable std::uint64_t exact_signs_ = 0;
};

/// Whether the corners lie exactly on one line.
bool has_zero_area(const Vector& a, const Vector& b, const Vector& c);

}  // namespace oracle
