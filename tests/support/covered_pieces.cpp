#include "support/covered_pieces.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>

namespace oracle {
namespace {

mpz_class det(const BigVector& a, const BigVector& b, const BigVector& c) { return dot(a, cross(b, c)); }

std::array<float, 3> place_of(const Vector& v) { return {v.x + 0.0f, v.y + 0.0f, v.z + 0.0f}; }  // -0 is 0

using Weights = std::array<mpz_class, 3>;

// Twice the area of a triangle of weights.
mpz_class area(const Weights& a, const Weights& b, const Weights& c) {
  return mpz_class((b[1] - a[1]) * (c[2] - a[2]) - (b[2] - a[2]) * (c[1] - a[1]));
}

// Whether an edge of the one leaves the other on its far side. Both turn the same way.
bool is_apart(const std::array<Weights, 3>& one, const std::array<Weights, 3>& other) {
  for (std::size_t i = 0; i < 3; ++i) {
    const bool all_out = std::all_of(other.begin(), other.end(),
                                     [&](const Weights& w) { return area(one[i], one[(i + 1) % 3], w) <= 0; });
    if (all_out) return true;
  }
  return false;
}

}  // namespace

// The directions of a piece, and its face.
struct PieceReferee::Cone {
  FaceId face;
  int side;
  std::array<Point, 3> corners;
  std::array<BigVector, 3> face_corners;

  // Not negative inside: sides 0 to 2 are the piece's. Positive inside: sides 3 to 5 are the face's outline.
  mpz_class within(std::size_t i, const BigVector& X) const {
    if (i < 3) return side * det(corners[i].X, corners[(i + 1) % 3].X, X);
    return side * det(face_corners[i - 3], face_corners[(i - 2) % 3], X);
  }
};

PieceReferee::PieceReferee(const Oracle& oracle, const std::vector<std::uint8_t>& is_solid, const Vector& origin)
    : oracle_(oracle),
      is_solid_(is_solid),
      origin_(origin),
      big_origin_(big(origin)),
      sides_(oracle.mesh().face_count(), 0) {
  for (std::size_t id = 0; id < sides_.size(); ++id) {
    const auto face = static_cast<FaceId>(id);
    sides_[id] = oracle.side(face, origin);
    if (!oracle.is_kept(face) || is_solid[id] == 0) continue;
    for (int k = 0; k < 3; ++k) {
      const Place a = place_of(oracle.mesh().vertex(id, k)), b = place_of(oracle.mesh().vertex(id, (k + 1) % 3));
      edges_[std::minmax(a, b)].push_back({face, a < b});
    }
  }
}

BigVector PieceReferee::corner(FaceId face, int k) const {
  return big(oracle_.mesh().vertex(static_cast<std::size_t>(face), k)) - big_origin_;
}

std::string PieceReferee::tiling_fault_of(const std::vector<CoveredPiece>& pieces) {
  std::uint64_t scale = 1;
  for (const CoveredPiece& piece : pieces) scale = std::max(scale, piece.scale);
  std::vector<std::array<Weights, 3>> triangles;
  mpz_class sum = 0;
  for (const CoveredPiece& piece : pieces) {
    std::array<Weights, 3> triangle;
    for (std::size_t i = 0; i < 3; ++i) {
      std::uint64_t total = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        total += piece.corners[i][k];
        triangle[i][k] = mpz_class(piece.corners[i][k] * (scale / piece.scale));
      }
      if (total != piece.scale) return "weights that are no mean";
    }
    const mpz_class own = area(triangle[0], triangle[1], triangle[2]);
    if (own <= 0) return "a piece turned the other way";
    sum += own;
    for (const auto& other : triangles) {
      if (!is_apart(triangle, other) && !is_apart(other, triangle)) return "pieces overlap";
    }
    triangles.push_back(triangle);
  }
  return sum == mpz_class(scale) * scale ? "" : "pieces do not make up the face";
}

PieceReferee::Cone PieceReferee::cone_of(FaceId face, const CoveredPiece& piece) const {
  Cone cone{face, sides_[static_cast<std::size_t>(face)], {}, {corner(face, 0), corner(face, 1), corner(face, 2)}};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& w = piece.corners[i];
    cone.corners[i].X = mpz_class(w[0]) * cone.face_corners[0] + mpz_class(w[1]) * cone.face_corners[1] +
                        mpz_class(w[2]) * cone.face_corners[2];
    cone.corners[i].w = piece.scale;
  }
  return cone;
}

bool PieceReferee::holds(const Cone& cone, const Vector& direction) const {
  for (std::size_t i = 0; i < 3; ++i) {
    if (cone.within(i, big(direction)) <= 0) return false;
  }
  return true;
}

// Whether a point P + t (Q - P), t from 0 to 1, lies in the cone and not on the face's outline.
bool PieceReferee::meets(const Cone& cone, const BigVector& P, const BigVector& Q) const {
  mpq_class low = 0, high = 1;
  bool low_is_open = false, high_is_open = false;
  for (std::size_t i = 0; i < 6; ++i) {
    const mpz_class p = cone.within(i, P), q = cone.within(i, Q);
    const bool is_open = i >= 3;
    if (p == q) {
      if (p < 0 || (p == 0 && is_open)) return false;
      continue;
    }
    mpq_class t(p, p - q);  // where p + t (q - p) is 0
    t.canonicalize();
    if (q > p) {
      if (t > low || (t == low && is_open)) low_is_open = is_open;
      low = std::max(low, t);
    } else {
      if (t < high || (t == high && is_open)) high_is_open = is_open;
      high = std::min(high, t);
    }
  }
  return low < high || (low == high && !low_is_open && !high_is_open);
}

// Cuts the piece to what `other` covers of it; there none of its points may be nearer, and those as near must lie on
// an edge of the face, unless `other` is first among equals.
bool PieceReferee::comes_before(FaceId other, const Cone& cone) const {
  const int side = sides_[static_cast<std::size_t>(other)];
  const BigVector a = corner(other, 0), b = corner(other, 1), c = corner(other, 2);
  std::vector<Point> polygon(cone.corners.begin(), cone.corners.end());
  for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
    std::vector<Point> cut;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
      const mpz_class at_p = side * det(from, to, p.X), at_q = side * det(from, to, q.X);
      if (at_p >= 0) cut.push_back(p);
      if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) {
        const mpz_class u = abs(at_q), v = abs(at_p);
        cut.push_back({u * p.X + v * q.X, u * p.w + v * q.w});
      }
    }
    polygon = cut;
  }
  const bool wins_ties = side != cone.side ? side < cone.side : other < cone.face;
  const BigVector n = cross(b - a, c - a);
  std::array<bool, 3> on_edge{true, true, true};
  bool any_equal = false;
  for (const Point& p : polygon) {
    const mpz_class beyond = side * dot(n, p.X - p.w * a);
    if (beyond < 0) return false;
    if (beyond > 0) continue;
    any_equal = true;
    for (std::size_t k = 0; k < 3; ++k) {
      if (det(cone.face_corners[k], cone.face_corners[(k + 1) % 3], p.X) != 0) on_edge[k] = false;
    }
  }
  return wins_ties || !any_equal || on_edge[0] || on_edge[1] || on_edge[2];
}

std::string PieceReferee::patch_fault_of(const Cone& cone, FaceId cover, const Vector& direction) const {
  const Mesh& mesh = oracle_.mesh();
  const auto side_of = [&](FaceId face) { return sides_[static_cast<std::size_t>(face)]; };
  std::set<FaceId> reached{cover};
  std::vector<FaceId> to_do{cover};
  while (!to_do.empty()) {
    const FaceId face = to_do.back();
    to_do.pop_back();
    if (!comes_before(face, cone)) return "face " + std::to_string(face) + " of the patch is not in front";
    for (int k = 0; k < 3; ++k) {
      const int next = (k + 1) % 3;
      if (!meets(cone, corner(face, k), corner(face, next))) continue;
      const auto id = static_cast<std::size_t>(face);
      const auto& both = edges_.at(std::minmax(place_of(mesh.vertex(id, k)), place_of(mesh.vertex(id, next))));
      if (both.size() != 2 || both[0].is_forward == both[1].is_forward) return "an edge that does not join two faces";
      const FaceId other = both[both[0].face == face ? 1 : 0].face;
      if (side_of(other) == 0) return "a face seen edge-on in the patch";
      if (reached.insert(other).second) to_do.push_back(other);
    }
  }
  // All turned the same way, or more of those that the direction meets one way than the other.
  if (std::all_of(reached.begin(), reached.end(), [&](FaceId face) { return side_of(face) == side_of(cover); }))
    return "";
  int sum = 0;
  const BigVector d = big(direction);
  for (const FaceId face : reached) {
    const BigVector a = corner(face, 0), b = corner(face, 1), c = corner(face, 2);
    const mpz_class least = std::min({mpz_class(side_of(face) * det(a, b, d)), mpz_class(side_of(face) * det(b, c, d)),
                                      mpz_class(side_of(face) * det(c, a, d))});
    if (least == 0) return "a direction to an edge of the patch";
    if (least > 0) sum += side_of(face);
  }
  return sum != 0 ? "" : "as many faces one way as the other";
}

std::string PieceReferee::fault_of(FaceId face, const std::vector<CoveredPiece>& pieces) const {
  if (pieces.empty()) return "no pieces";
  if (std::string fault = tiling_fault_of(pieces); !fault.empty()) return fault;
  const View view = oracle_.from(origin_);
  for (const CoveredPiece& piece : pieces) {
    const Cone cone = cone_of(face, piece);
    if (!holds(cone, piece.direction)) return "a direction that is not in the piece";
    if (!is_solid_[static_cast<std::size_t>(piece.cover)] || !oracle_.is_kept(piece.cover) ||
        sides_[static_cast<std::size_t>(piece.cover)] == 0)
      return "no cover";
    if (!view.meets(piece.cover, piece.direction)) return "a cover that the direction does not meet";
    if (std::string fault = patch_fault_of(cone, piece.cover, piece.direction); !fault.empty()) return fault;
  }
  return "";
}

}  // namespace oracle
