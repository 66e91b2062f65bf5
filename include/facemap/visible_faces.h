#pragma once

#include <facemap/face.h>
#include <facemap/vector.h>

#include <array>
#include <cstdint>
#include <vector>

namespace facemap {

/// A face is visible from an origin if some direction w of float32 numbers meets it first, strictly inside it: it is
/// the face that Viewpoint::nearest(w) names. It is hidden if it is so for no direction at all, of real numbers too.
enum class FaceVisibility : std::uint8_t { Hidden, Visible, Undecided };

/// Why a face is hidden.
enum class HiddenReason : std::uint8_t {
  None,     ///< it is not, or it is not known
  LeftOut,  ///< it is odd, or its material takes it away: no map has it
  EdgeOn,   ///< the origin lies on its plane
  Covered   ///< others stand before it: Viewpoint::covered_pieces
};

/// An answer for each face of a scene. None is ever wrong; few are undecided.
struct VisibleFaces {
  std::vector<FaceVisibility> faces;
  std::vector<Vector> witnesses;  ///< the direction w for visible faces, else zero
  std::vector<HiddenReason> reasons;
};

/// A piece of a hidden face, and what hides it. Take the face `cover` and all faces that are reached from it across
/// edges that the piece meets. Each such edge belongs to two faces, which have it in opposite directions, and each face
/// stands before the hidden one wherever both are seen in the piece. Then the faces that are met along a direction,
/// those turned towards the origin less those turned away, are as many in all of the piece; along `direction` they are
/// not 0. So one of the faces is seen in every direction of the piece (docs/algorithm.md).
struct CoveredPiece {
  std::uint64_t scale = 1;                                ///< corners are in parts of it: a power of two
  std::array<std::array<std::uint64_t, 3>, 3> corners{};  ///< each as a mean of the face's corners, with these weights
  FaceId cover = kNoFace;
  Vector direction{0};  ///< from the origin, strictly inside the piece; it meets `cover`
};

}  // namespace facemap
