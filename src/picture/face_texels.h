#pragma once

#include <algorithm>
#include <cstddef>

namespace facemap {

/// How a face lies on the texels of a light's square raster (simd/shadow_frame.h), from the computed places of its
/// corners: every texel that it may meet, with a bound of w there on either side. All bounds hold for the true face and
/// for every true point whose computed place is in the texel (kShadowMargin).
class FaceTexels {
 public:
  /// One texel and the face.
  struct Piece {
    std::size_t texel;      ///< row * size + column
    float least, greatest;  ///< bounds of the w of the face's points there
    bool is_within;         ///< the face surely covers all of the texel
  };

  /// Corners are (u, v, w) with w above 0; `size`: texels a side.
  FaceTexels(const float* a, const float* b, const float* c, int size);

  /// Above 0: the face is surely turned away from the light; below 0: towards it; 0: not known.
  int side() const { return side_; }

  /// Whether it may meet some texel.
  bool any() const { return column0_ <= column1_ && row0_ <= row1_; }

  /// The texels' box, and how many it has.
  std::size_t box_size() const {
    return any() ? static_cast<std::size_t>(column1_ - column0_ + 1) * static_cast<std::size_t>(row1_ - row0_ + 1) : 0;
  }
  int column0() const { return column0_; }
  int column1() const { return column1_; }
  int row0() const { return row0_; }
  int row1() const { return row1_; }

  /// First and last column; none if the first is after the last.
  struct Span {
    int first, last;
  };

  /// The texels of a row, any row.
  Span columns_in(int row) const {
    if (row < row0_ || row > row1_) return {0, -1};
    return is_large_ ? span_in(row, 1) : Span{column0_, column1_};
  }

  /// Calls visit(piece), row by row.
  template <class Visit>
  void for_each(const Visit& visit) const {
    for (int row = row0_; row <= row1_; ++row) {
      const Span all = columns_in(row);
      const Span within = is_large_ ? span_in(row, -1) : Span{0, -1};
      for (int column = all.first; column <= all.last; ++column) {
        Piece piece{static_cast<std::size_t>(row) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(column),
                    least_, greatest_, within.first <= column && column <= within.last};
        if (has_plane_) narrow(column, row, piece);
        visit(piece);
      }
    }
  }

 private:
  Span span_in(int row, int sign) const;

  // In the plane of the raster, w may be bounded more closely than by its corners.
  void narrow(int column, int row, Piece& piece) const {
    const double u = (2 * column + 1) * half_ - 1 - plane_.u, v = (2 * row + 1) * half_ - 1 - plane_.v;
    const double w = plane_.w + plane_.by_u * u + plane_.by_v * v;
    piece.least = std::max(piece.least, static_cast<float>(w - plane_.range));
    piece.greatest = std::min(piece.greatest, static_cast<float>(w + plane_.range));
  }

  // An edge as a function of a texel's middle: at + by_u u + by_v v is at least -range in each texel that the face may
  // meet, at least range only in texels that are within the edge.
  struct Edge {
    double at, by_u, by_v, range;
  };
  struct Plane {
    double u, v, w;     // of the first corner
    double by_u, by_v;  // slopes of w
    double range;       // of w about its value in a texel's middle
  };

  int size_;
  double half_;  // of a texel's width
  int side_ = 0;
  int column0_, column1_, row0_, row1_;
  float least_, greatest_;
  bool is_large_ = false, has_plane_ = false;
  Edge edges_[3];
  Plane plane_;
};

/// The texel of a coordinate in -1..1, of `size`; as the kernels have it.
int texel_of(float coordinate, int size);

}  // namespace facemap
