#include <facemap/compare.h>
#include <facemap/error.h>

#include <cerrno>
#include <fstream>
#include <iterator>
#include <system_error>

#include "image/decode_exr.h"
#include "image/decode_jpeg.h"
#include "image/decode_pfm.h"
#include "image/decode_png.h"

namespace facemap {
namespace {

constexpr std::size_t kMaxBytes = std::size_t{1} << 34;

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path) {
  const auto refuse = [&](LoadError::Cause cause, const std::string& reason) {
    throw LoadError(cause, path.string(), 0, reason);
  };
  std::error_code ignored;
  if (std::filesystem::is_directory(path, ignored)) refuse(LoadError::Cause::CannotOpen, "cannot open: it is a folder");
  errno = 0;
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(LoadError::Cause::CannotOpen, "cannot open: " + std::generic_category().message(errno));
  constexpr std::size_t kStep = std::size_t{1} << 20;
  std::vector<std::uint8_t> bytes;
  while (file) {
    const std::size_t size = bytes.size();
    if (size > kMaxBytes) refuse(LoadError::Cause::TooLarge, "it is larger than 16 GiB");
    bytes.resize(size + kStep);
    file.read(reinterpret_cast<char*>(bytes.data() + size), kStep);
    bytes.resize(size + static_cast<std::size_t>(file.gcount()));
  }
  if (file.bad()) refuse(LoadError::Cause::CannotOpen, "cannot read: " + std::generic_category().message(errno));
  return bytes;
}

/// Every fourth level, from that of `channel` on, divided by `divisor`.
template <typename Level>
std::vector<float> levels_of(const std::vector<Level>& rgba, std::size_t channel, float divisor) {
  std::vector<float> levels(rgba.size() / 4);
  for (std::size_t i = 0; i < levels.size(); ++i) levels[i] = static_cast<float>(rgba[4 * i + channel]) / divisor;
  return levels;
}

template <typename Level>
PictureChannels channels_of(const std::string& name, int width, int height, const std::vector<Level>& rgba) {
  constexpr Level kOpaque = static_cast<Level>(~Level{0});
  constexpr float kDivisor = kOpaque / 255;
  PictureChannels picture{name, width, height, PictureChannels::Unit::Levels, {}};
  bool is_opaque = true;
  for (std::size_t i = 3; i < rgba.size() && is_opaque; i += 4) is_opaque = rgba[i] == kOpaque;
  if (!is_opaque) picture.channels.push_back({"A", levels_of(rgba, 3, kDivisor)});
  picture.channels.push_back({"B", levels_of(rgba, 2, kDivisor)});
  picture.channels.push_back({"G", levels_of(rgba, 1, kDivisor)});
  picture.channels.push_back({"R", levels_of(rgba, 0, kDivisor)});
  return picture;
}

}  // namespace

PictureChannels read_picture(const std::filesystem::path& path, std::uint64_t max_pixels) {
  const std::vector<std::uint8_t> bytes = read_bytes(path);
  const std::string name = path.string();
  if (is_png_16(bytes)) {
    const DecodedImage16 image = decode_png_16(bytes, name, max_pixels);
    return channels_of(name, image.width, image.height, image.rgba);
  }
  if (is_png(bytes) || is_jpeg(bytes)) {
    const DecodedImage image = decode_image(bytes, name, max_pixels);
    return channels_of(name, image.width, image.height, image.rgba);
  }
  if (is_pfm(bytes)) return decode_pfm(bytes, name, max_pixels);
  if (is_exr(bytes)) return decode_exr(bytes, name, max_pixels);
  throw LoadError(LoadError::Cause::UnknownFormat, name, 0, "it is neither PNG, JPEG, PFM nor EXR");
}

}  // namespace facemap
