#pragma once

#include <facemap/image.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <variant>
#include <vector>

namespace facemap {

/// All that a picture's file holds, channel by channel.
struct PictureChannels {
  enum class Unit {
    Levels,  ///< 0..255 (PNG, JPEG); 16 bits in steps of 1/257
    Values,  ///< numbers as they are (PFM, EXR)
  };
  struct Channel {
    std::string name;                                                     ///< "R", "depth.Z"
    std::variant<std::vector<float>, std::vector<std::uint32_t>> values;  ///< rows from the top; uint32: EXR's UINT
  };

  std::string name;  ///< of the file, for messages
  int width = 0;
  int height = 0;
  Unit unit = Unit::Levels;
  std::vector<Channel> channels;  ///< by name; "A" is left out where all is opaque, a PFM of one channel has "Y"
};

/// Reads PNG, JPEG, PFM or EXR; which of them the bytes say. Throws LoadError.
PictureChannels read_picture(const std::filesystem::path& path, std::uint64_t max_pixels = std::uint64_t{1} << 28);

/// How two pictures differ. A difference is the distance of two numbers, in the unit of the pictures: 0 for two NaN
/// or the same infinity, infinity if only one of them is that. A picture without "A" is opaque.
struct Comparison {
  double largest = 0;                ///< of all channels of all pixels
  double mean = 0;                   ///< over all channels of all pixels
  double psnr = 0;                   ///< decibels below the peak: 255 levels, or a value of 1; infinity: equal
  std::uint64_t different = 0;       ///< pixels that differ
  std::uint64_t beyond = 0;          ///< pixels that differ by more than the threshold in some channel
  int largest_x = 0, largest_y = 0;  ///< where the largest difference is first, from the upper left
  std::string largest_channel;       ///< empty: equal
};

/// Throws Error if the pictures differ in size, unit or channels; it says how.
Comparison compare_pictures(const PictureChannels& a, const PictureChannels& b, double threshold = 0);

/// A picture of the differences: black where there is none, the largest is white or a full colour. Other channels than
/// R, G and B show in grey.
Image difference_picture(const PictureChannels& a, const PictureChannels& b);

}  // namespace facemap
