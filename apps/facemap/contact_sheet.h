#pragma once

#include <facemap/image.h>

#include <cstddef>
#include <vector>

namespace facemap::program {

/// What is odd about a picture of a model.
enum class PictureFlag {
  None,
  Empty,  ///< hardly any pixel sees a face
  Black,  ///< nearly all that is seen is black
  White,  ///< nearly all that is seen is white
};

/// The picture must have `ids`. Pixels at outlines do not count for black and white.
PictureFlag flag_of(const Image& picture);

/// "empty", "nearly black", "nearly white"; nothing for None.
const char* name_of(PictureFlag flag);

/// Pictures of one size, side by side in rows, each with its number from 1 in the corner. What was not drawn is crossed
/// out.
class ContactSheet {
 public:
  /// Throws Error if the sheet has more than kMaxPixels.
  ContactSheet(std::size_t count, int columns, int width, int height);

  /// Put a picture, or a cross, in place `index`.
  void put(std::size_t index, const Image& picture);
  void cross_out(std::size_t index);

  const Image& image() const { return image_; }

 private:
  struct Corner {
    int x, y;
  };
  Corner corner(std::size_t index) const;
  void number(std::size_t index);

  int columns_, width_, height_;
  Image image_;
};

}  // namespace facemap::program
