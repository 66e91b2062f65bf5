#pragma once

#include <facemap/mesh.h>
#include <facemap/scene.h>
#include <facemap/visible_faces.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "math/dvector.h"
#include "math/exact_sign.h"

namespace facemap {

/// A vertex as the origin sees it.
struct SeenVertex {
  SeenVertex() = default;
  SeenVertex(const Vector& position, std::uint32_t vertex, const Vector& origin);

  Vector position{0};
  std::uint32_t vertex = 0;  ///< the first of its position
  DVector offset{0};         ///< from the origin, rounded
  double size = 0;           ///< its largest component
};

/// A face that the origin does not see edge-on.
struct SeenFace {
  SeenFace() = default;
  SeenFace(const Scene& scene, std::uint32_t face, int side, const Vector& origin);

  bool has(std::uint32_t vertex) const {
    return vertex == vertices[0].vertex || vertex == vertices[1].vertex || vertex == vertices[2].vertex;
  }
  Triangle triangle() const { return {vertices[0].position, vertices[1].position, vertices[2].position}; }

  std::uint32_t id = 0;
  int side = 0;  ///< exact, not 0
  std::array<SeenVertex, 3> vertices;
  DVector first_edge{0}, last_edge{0};  ///< from the first corner to the two others, rounded
  DVector normal{0};
  double edge = 0;   ///< largest component of the three edges
  double reach = 0;  ///< no less than a component of any point of the face from the origin
};

/// A triangle within a face, all directions in which the origin sees it, and what else lies in these. The face's own
/// outline is not part of a piece, the other sides of its triangle are. What is sure is so for the real numbers.
class FacePiece {
 public:
  using Weights = std::array<std::uint64_t, 3>;  ///< of the face's corners, in parts of a scale

  FacePiece() = default;

  /// All of a face.
  FacePiece(const SeenFace& face, const Vector& origin);

  const SeenFace& face() const { return *face_; }
  std::uint64_t scale() const { return scale_; }  ///< a power of two
  const std::array<Weights, 3>& corners() const { return weights_; }

  /// The direction to its middle, rounded to floats: it may lie outside.
  Vector middle() const;

  /// Whether a direction that lies strictly inside the face surely lies in the piece.
  bool surely_holds(const Vector& direction) const;

  /// Whether some direction of the piece may meet the edge between two vertices. They and the origin are not on one
  /// line.
  bool may_meet(const SeenVertex& p, const SeenVertex& q) const;

  /// Whether `other` comes before the piece's face in each direction of the piece that meets both: it is nearer, or
  /// as near and first in the order of equals.
  bool surely_yields_to(const SeenFace& other) const;

  /// Where a piece may be cut: a linear function at its corners that is 0 there, up to the slack.
  struct Cut {
    std::array<double, 3> heights{};
    double slack = 0;
  };

  /// Along the edge between corner k and the next; where the face's plane passes through the piece.
  Cut along_edge(const SeenFace& other, std::size_t k) const;
  Cut along_plane(const SeenFace& other) const;

  /// Adds pieces that make up this one: it is cut beside such a line, on the side of its middle, or else in halves.
  /// They refer to `whole`, all of the face. Adds nothing if they would be too small.
  void divide(const Cut& cut, const FacePiece& whole, std::vector<FacePiece>& pieces) const;

 private:
  FacePiece(const SeenFace& face, const FacePiece* whole, const Vector& origin, std::uint64_t scale,
            const std::array<Weights, 3>& weights);

  // The side from corner i to the next: its plane through the origin, positive inside.
  struct Side {
    DVector normal{0};
    double error = 0;  // of a product with a vector of largest component 1
  };

  bool is_whole() const { return scale_ == 1; }
  const SeenVertex* corner_of_face(std::size_t i) const;
  bool is_outside(std::size_t side, const SeenVertex& p) const;
  bool is_to_one_side_of(const SeenVertex& p, const SeenVertex& q) const;
  bool surely_misses(const SeenVertex& p, const SeenVertex& q) const;
  bool is_behind_corners_of(const SeenFace& other, bool other_wins_ties) const;
  bool is_behind_plane_of(const SeenFace& other) const;
  std::size_t longest_side() const;

  const SeenFace* face_ = nullptr;
  const FacePiece* whole_ = nullptr;  // all of the face: null if this is
  Vector origin_{0};
  std::uint64_t scale_ = 1;
  std::array<Weights, 3> weights_{};
  std::array<DVector, 3> points_{};  // corners from the origin
  std::array<Side, 3> sides_{};
};

}  // namespace facemap
