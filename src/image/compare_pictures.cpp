#include <facemap/compare.h>
#include <facemap/error.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/elementary.h"
#include "simd/floating_point_mode.h"

namespace facemap {
namespace {

using Channel = PictureChannels::Channel;

/// The channels of one name; null: opaque.
struct ChannelPair {
  std::string name;
  const Channel* a = nullptr;
  const Channel* b = nullptr;
};

double opaque_value(PictureChannels::Unit unit) { return unit == PictureChannels::Unit::Levels ? 255 : 1; }

std::string size_text(const PictureChannels& picture) {
  return std::to_string(picture.width) + "x" + std::to_string(picture.height) + " pixels";
}

std::string unit_text(const PictureChannels& picture) {
  return picture.unit == PictureChannels::Unit::Levels ? "levels (PNG, JPEG)" : "values (PFM, EXR)";
}

std::string channels_text(const PictureChannels& picture) {
  std::string text = "the channels";
  for (const Channel& channel : picture.channels) text += " " + channel.name;
  return text;
}

[[noreturn]] void refuse(const PictureChannels& a, const PictureChannels& b,
                         std::string (*text)(const PictureChannels&)) {
  throw Error(a.name + " has " + text(a) + ", " + b.name + " has " + text(b));
}

/// The two lists are by name.
std::vector<ChannelPair> pair_channels(const PictureChannels& a, const PictureChannels& b) {
  std::vector<ChannelPair> pairs;
  std::size_t i = 0, k = 0;
  while (i < a.channels.size() || k < b.channels.size()) {
    const Channel* one = i < a.channels.size() ? &a.channels[i] : nullptr;
    const Channel* other = k < b.channels.size() ? &b.channels[k] : nullptr;
    if (one && other && one->name != other->name) (one->name < other->name ? other : one) = nullptr;
    const std::string& name = one ? one->name : other->name;
    if ((!one || !other) && name != "A") refuse(a, b, channels_text);
    pairs.push_back({name, one, other});
    i += one != nullptr;
    k += other != nullptr;
  }
  return pairs;
}

std::vector<ChannelPair> check_and_pair(const PictureChannels& a, const PictureChannels& b) {
  if (a.width != b.width || a.height != b.height) refuse(a, b, size_text);
  if (a.unit != b.unit) refuse(a, b, unit_text);
  return pair_channels(a, b);
}

double distance(double a, double b) {
  if (a == b || (std::isnan(a) && std::isnan(b))) return 0;
  const double difference = std::fabs(a - b);
  return std::isnan(difference) ? std::numeric_limits<double>::infinity() : difference;
}

double value_at(const Channel* channel, std::size_t i, double otherwise) {
  if (!channel) return otherwise;
  if (const auto* const floats = std::get_if<std::vector<float>>(&channel->values)) return (*floats)[i];
  return std::get<std::vector<std::uint32_t>>(channel->values)[i];
}

/// Calls visit(difference, i) for every pixel.
template <typename Visit>
void for_differences(const ChannelPair& pair, std::size_t pixels, double opaque, const Visit& visit) {
  for (std::size_t i = 0; i < pixels; ++i) visit(distance(value_at(pair.a, i, opaque), value_at(pair.b, i, opaque)), i);
}

std::size_t pixels_of(const PictureChannels& picture) {
  return static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
}

double decibels(double peak, double mean_square) {
  if (mean_square == 0) return std::numeric_limits<double>::infinity();
  if (std::isinf(mean_square)) return -std::numeric_limits<double>::infinity();
  return 10 * elementary::log(peak * peak / mean_square) / elementary::log(10);
}

}  // namespace

Comparison compare_pictures(const PictureChannels& a, const PictureChannels& b, double threshold) {
  const FloatingPointMode mode;
  const std::vector<ChannelPair> pairs = check_and_pair(a, b);
  const double opaque = opaque_value(a.unit);
  const std::size_t pixels = pixels_of(a);
  std::vector<bool> differs(pixels), is_beyond(pixels);
  Comparison result;
  double sum = 0, squares = 0;
  for (const ChannelPair& pair : pairs) {
    for_differences(pair, pixels, opaque, [&](double difference, std::size_t i) {
      if (difference == 0) return;
      sum += difference;
      squares += difference * difference;
      differs[i] = true;
      if (difference > threshold) is_beyond[i] = true;
      if (difference <= result.largest) return;
      result.largest = difference;
      result.largest_x = static_cast<int>(i % static_cast<std::size_t>(a.width));
      result.largest_y = static_cast<int>(i / static_cast<std::size_t>(a.width));
      result.largest_channel = pair.name;
    });
  }
  const double count = static_cast<double>(pixels) * static_cast<double>(pairs.size());
  result.mean = sum / count;
  result.psnr = decibels(opaque, squares / count);
  result.different = static_cast<std::uint64_t>(std::count(differs.begin(), differs.end(), true));
  result.beyond = static_cast<std::uint64_t>(std::count(is_beyond.begin(), is_beyond.end(), true));
  return result;
}

Image difference_picture(const PictureChannels& a, const PictureChannels& b) {
  const FloatingPointMode mode;
  const std::vector<ChannelPair> pairs = check_and_pair(a, b);
  const double opaque = opaque_value(a.unit);
  const std::size_t pixels = pixels_of(a);
  double largest = 0;
  for (const ChannelPair& pair : pairs) {
    for_differences(pair, pixels, opaque, [&](double difference, std::size_t) {
      if (std::isfinite(difference)) largest = std::max(largest, difference);
    });
  }
  // A difference of whatever size shows.
  const auto level = [&](double difference) {
    if (difference == 0) return std::uint32_t{0};
    if (difference >= largest) return std::uint32_t{255};
    return static_cast<std::uint32_t>(std::ceil(difference / largest * 255));
  };

  std::vector<std::uint32_t> levels(pixels);
  for (const ChannelPair& pair : pairs) {
    const std::uint32_t place = pair.name == "R" ? 0x10000 : pair.name == "G" ? 0x100 : pair.name == "B" ? 1 : 0x10101;
    for_differences(pair, pixels, opaque, [&](double difference, std::size_t i) {
      const std::uint32_t shown = level(difference) * place;
      std::uint32_t sum = 0;
      for (const std::uint32_t mask : {0xff0000u, 0xff00u, 0xffu}) sum |= std::max(levels[i] & mask, shown & mask);
      levels[i] = sum;
    });
  }
  Image image;
  image.width = a.width;
  image.height = a.height;
  image.pixels.reserve(pixels);
  for (const std::uint32_t rgb : levels) image.pixels.push_back(Color::from_24_bit(rgb));
  return image;
}

}  // namespace facemap
