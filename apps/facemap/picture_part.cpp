#include "picture_part.h"

#include "usage_error.h"

namespace facemap::program {
namespace {

constexpr int kMostPixels = 32768;  // a side

PixelBox parse_crop(const std::string& text) {
  const std::size_t first = text.find(','), second = text.find(',', first + 1);
  if (first == std::string::npos || second == std::string::npos) {
    throw UsageError("'" + text + "' is not X,Y,WxH, such as 100,50,640x480");
  }
  const Size size = parse_size(text.substr(second + 1));
  return {parse_whole_number(text.substr(0, first), 0, kMostPixels),
          parse_whole_number(text.substr(first + 1, second - first - 1), 0, kMostPixels), size.width, size.height};
}

void parse_tile(const std::string& text, WantedPart& part) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) throw UsageError("'" + text + "' is not I/N, such as 1/4");
  part.tiles = parse_whole_number(text.substr(slash + 1), 1, kMostPixels);
  part.tile = parse_whole_number(text.substr(0, slash), 1, part.tiles);
}

}  // namespace

std::optional<PixelBox> WantedPart::pixels(const Size& size) const {
  if (crop && tiles > 0) throw UsageError("--crop and --tile both say which part to make; give one");
  const std::string picture = "a picture of " + std::to_string(size.width) + "x" + std::to_string(size.height);
  if (crop) {
    if (crop->width > size.width - crop->x || crop->height > size.height - crop->y) {
      throw UsageError("--crop reaches beyond " + picture);
    }
    return crop;
  }
  if (tiles == 0) return std::nullopt;
  if (tiles > size.height) throw UsageError("--tile: " + picture + " has too few rows for " + std::to_string(tiles));
  const auto row = [&](int i) { return static_cast<int>(static_cast<long long>(size.height) * i / tiles); };
  return PixelBox{0, row(tile - 1), size.width, row(tile) - row(tile - 1)};
}

std::vector<Option> part_options(WantedPart& part) {
  return {
      {"--crop", "X,Y,WxH", "",
       "makes only W x H of the picture's pixels, from column X and row Y on: the same pixels as in the whole",
       into(part.crop, parse_crop)},
      {"--tile", "I/N", "",
       "makes only the I-th of N bands of rows, I from 1 to N: below each other they are the whole",
       [&part](const std::string& text) { parse_tile(text, part); }},
  };
}

}  // namespace facemap::program
