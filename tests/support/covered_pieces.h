#pragma once

#include <facemap/visible_faces.h>

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "support/big_numbers.h"
#include "support/oracle.h"

namespace oracle {

using facemap::CoveredPiece;

/// Whether pieces prove that a face is hidden: that they make it up, and that what covers each of them does. In GMP
/// integers, with edges and patches of its own.
class PieceReferee {
 public:
  /// Patches are made of faces that are kept and solid, one byte a face. All must outlive this.
  PieceReferee(const Oracle& oracle, const std::vector<std::uint8_t>& is_solid, const Vector& origin);

  /// Empty if they do, else what is wrong.
  std::string fault_of(FaceId face, const std::vector<CoveredPiece>& pieces) const;

 private:
  struct HalfEdge {
    FaceId face;
    bool is_forward;
  };
  using Place = std::array<float, 3>;

  // A point from the origin, X / w, w > 0.
  struct Point {
    BigVector X;
    mpz_class w;
  };
  struct Cone;

  BigVector corner(FaceId face, int k) const;
  static std::string tiling_fault_of(const std::vector<CoveredPiece>& pieces);
  Cone cone_of(FaceId face, const CoveredPiece& piece) const;
  bool holds(const Cone& cone, const Vector& direction) const;
  bool meets(const Cone& cone, const BigVector& P, const BigVector& Q) const;
  bool comes_before(FaceId other, const Cone& cone) const;
  std::string patch_fault_of(const Cone& cone, FaceId cover, const Vector& direction) const;

  const Oracle& oracle_;
  const std::vector<std::uint8_t>& is_solid_;
  Vector origin_;
  BigVector big_origin_;
  std::vector<int> sides_;
  std::map<std::pair<Place, Place>, std::vector<HalfEdge>> edges_;
};

}  // namespace oracle
