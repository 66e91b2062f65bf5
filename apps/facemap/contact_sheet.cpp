#include "contact_sheet.h"

#include <facemap/error.h>

#include <algorithm>
#include <string>

#include "digits.h"
#include "text_values.h"

namespace facemap::program {
namespace {

constexpr int kGap = 2;                // pixels between pictures
constexpr double kHardlyAny = 0.002;   // share of the pixels: a line across a picture of 256 x 256 is 0.004
constexpr double kNearlyAll = 0.98;    // share of the pixels well within what is seen
constexpr std::uint32_t kBlack = 6;    // 8-bit sRGB level of the brightest channel
constexpr std::uint32_t kWhite = 250;  // of the darkest

const Color kBetween = Color::from_24_bit(0x303030);
const Color kNothing = Color::from_24_bit(0x707070);
const Color kCross = Color::from_24_bit(0xc03030);
const Color kInk = Color::from_24_bit(0xffffff);
const Color kLabel = Color::from_24_bit(0x202020);

struct Levels {
  std::uint32_t least, greatest;
};

Levels levels_of(const Color& color) {
  const std::uint32_t rgb = color.to_24_bit(), r = rgb >> 16, g = rgb >> 8 & 255, b = rgb & 255;
  return {std::min({r, g, b}), std::max({r, g, b})};
}

std::size_t place(const Image& picture, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(picture.width) + static_cast<std::size_t>(x);
}

bool sees_face(const Image& picture, int x, int y) {
  return x >= 0 && y >= 0 && x < picture.width && y < picture.height && picture.ids[place(picture, x, y)] != kNoFace;
}

// Whether the pixels beside it see faces too: then no background is mixed in.
bool is_inside(const Image& picture, int x, int y) {
  for (int v = -1; v <= 1; ++v) {
    for (int u = -1; u <= 1; ++u) {
      if (!sees_face(picture, x + u, y + v)) return false;
    }
  }
  return true;
}

}  // namespace

PictureFlag flag_of(const Image& picture) {
  std::size_t seen = 0, whole = 0, black = 0, white = 0;
  for (int y = 0; y < picture.height; ++y) {
    for (int x = 0; x < picture.width; ++x) {
      if (!sees_face(picture, x, y)) continue;
      ++seen;
      if (!is_inside(picture, x, y)) continue;
      ++whole;
      const Levels levels = levels_of(picture.pixels[place(picture, x, y)]);
      black += levels.greatest <= kBlack;
      white += levels.least >= kWhite;
    }
  }
  const auto count = static_cast<double>(whole);
  if (static_cast<double>(seen) < kHardlyAny * static_cast<double>(picture.ids.size())) return PictureFlag::Empty;
  if (whole > 0 && static_cast<double>(black) >= kNearlyAll * count) return PictureFlag::Black;
  if (whole > 0 && static_cast<double>(white) >= kNearlyAll * count) return PictureFlag::White;
  return PictureFlag::None;
}

const char* name_of(PictureFlag flag) {
  switch (flag) {
    case PictureFlag::Empty:
      return "empty";
    case PictureFlag::Black:
      return "nearly black";
    case PictureFlag::White:
      return "nearly white";
    case PictureFlag::None:
      break;
  }
  return "";
}

ContactSheet::ContactSheet(std::size_t count, int columns, int width, int height)
    : columns_(columns), width_(width), height_(height) {
  const auto rows =
      static_cast<long long>((count + static_cast<std::size_t>(columns) - 1) / static_cast<std::size_t>(columns));
  const long long across = static_cast<long long>(columns) * (width + kGap) + kGap,
                  down = rows * (height + kGap) + kGap;
  if (across * down > kMaxPixels) throw Error("the sheet would be too large: choose a smaller --size");
  image_.width = static_cast<int>(across);
  image_.height = static_cast<int>(down);
  image_.pixels.assign(static_cast<std::size_t>(across * down), kBetween);
}

ContactSheet::Corner ContactSheet::corner(std::size_t index) const {
  const auto column = static_cast<int>(index % static_cast<std::size_t>(columns_));
  const auto row = static_cast<int>(index / static_cast<std::size_t>(columns_));
  return {kGap + column * (width_ + kGap), kGap + row * (height_ + kGap)};
}

void ContactSheet::number(std::size_t index) {
  const auto [x, y] = corner(index);
  const std::string digits = std::to_string(index + 1);
  const int scale = std::max(1, height_ / 128);
  fill_rectangle(image_, x, y, digits_width(digits, scale) + 4 * scale, (kDigitHeight + 4) * scale, kLabel);
  draw_digits(image_, digits, x + 2 * scale, y + 2 * scale, scale, kInk);
}

void ContactSheet::put(std::size_t index, const Image& picture) {
  const auto [x, y] = corner(index);
  for (int row = 0; row < height_; ++row) {
    std::copy_n(picture.pixels.begin() + static_cast<std::ptrdiff_t>(row) * width_, width_,
                image_.pixels.begin() + static_cast<std::ptrdiff_t>(y + row) * image_.width + x);
  }
  number(index);
}

void ContactSheet::cross_out(std::size_t index) {
  const auto [x, y] = corner(index);
  const int thickness = std::max(2, std::min(width_, height_) / 64);
  fill_rectangle(image_, x, y, width_, height_, kNothing);
  for (int i = 0; i + thickness <= width_; ++i) {
    const int down =
        static_cast<int>(static_cast<long long>(i) * (height_ - thickness) / std::max(1, width_ - thickness));
    fill_rectangle(image_, x + i, y + down, thickness, thickness, kCross);
    fill_rectangle(image_, x + width_ - thickness - i, y + down, thickness, thickness, kCross);
  }
  number(index);
}

}  // namespace facemap::program
