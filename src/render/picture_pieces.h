#pragma once

#include <facemap/renderer.h>

#include <limits>

namespace facemap {

/// The pieces that a picture consists of, as a cube map of six faces: pixels of two of them may lie side by side, but
/// what they show does not. Pixels are counted from the first one that is made.
struct PicturePieces {
  int width = std::numeric_limits<int>::max();  ///< of each piece, in pixels; as it stands: all are one piece
  int height = std::numeric_limits<int>::max();
  int first_column = 0, first_row = 0;  ///< of the picture's pixels: those that are made begin there

  static PicturePieces of(const View& view, const PixelBox& made) {
    if (view.is_parallel || !view.lens) return {};
    return {view.lens->piece_width(), view.lens->piece_height(), made.x, made.y};
  }

  /// Whether two pixels belong to the same piece.
  bool are_one(int x, int y, int u, int v) const {
    return (first_column + x) / width == (first_column + u) / width &&
           (first_row + y) / height == (first_row + v) / height;
  }
};

}  // namespace facemap
