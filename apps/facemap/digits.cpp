#include "digits.h"

#include <algorithm>

namespace facemap::program {
namespace {

/// Rows from the top, one text of 5 dots each.
constexpr const char* kDigits[10][kDigitHeight] = {
    {" ### ", "#   #", "#  ##", "# # #", "##  #", "#   #", " ### "},
    {"  #  ", " ##  ", "  #  ", "  #  ", "  #  ", "  #  ", " ### "},
    {" ### ", "#   #", "    #", "   # ", "  #  ", " #   ", "#####"},
    {"#####", "   # ", "  #  ", "   # ", "    #", "#   #", " ### "},
    {"   # ", "  ## ", " # # ", "#  # ", "#####", "   # ", "   # "},
    {"#####", "#    ", "#### ", "    #", "    #", "#   #", " ### "},
    {"  ## ", " #   ", "#    ", "#### ", "#   #", "#   #", " ### "},
    {"#####", "    #", "   # ", "  #  ", " #   ", " #   ", " #   "},
    {" ### ", "#   #", "#   #", " ### ", "#   #", "#   #", " ### "},
    {" ### ", "#   #", "#   #", " ####", "    #", "   # ", " ##  "},
};

}  // namespace

int digits_width(const std::string& digits, int scale) {
  return scale * (static_cast<int>(digits.size()) * (kDigitWidth + 1) - 1);
}

void draw_digits(Image& image, const std::string& digits, int x, int y, int scale, const Color& color) {
  for (const char digit : digits) {
    for (int row = 0; row < kDigitHeight; ++row) {
      for (int column = 0; column < kDigitWidth; ++column) {
        if (kDigits[digit - '0'][row][column] == ' ') continue;
        fill_rectangle(image, x + column * scale, y + row * scale, scale, scale, color);
      }
    }
    x += (kDigitWidth + 1) * scale;
  }
}

void fill_rectangle(Image& image, int x, int y, int width, int height, const Color& color) {
  for (int row = std::max(y, 0); row < std::min(y + height, image.height); ++row) {
    for (int column = std::max(x, 0); column < std::min(x + width, image.width); ++column) {
      image.pixels[static_cast<std::size_t>(row) * static_cast<std::size_t>(image.width) +
                   static_cast<std::size_t>(column)] = color;
    }
  }
}

}  // namespace facemap::program
