#include "image/exr_file.h"

#include <facemap/error.h>
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <initializer_list>
#include <string_view>

// The layout: openexr.com, "OpenEXR File Layout". All numbers have their lowest byte first.
namespace facemap::exr {
namespace {

using Bytes = std::vector<std::uint8_t>;
static_assert(std::endian::native == std::endian::little, "values are written as they lie in memory");

constexpr int kLevel = 4;                                ///< of zlib, as OpenEXR has it
constexpr std::size_t kShortName = 31, kLongName = 255;  ///< bytes

template <typename Value>
void append(Bytes& bytes, Value value) {
  const std::size_t size = bytes.size();
  bytes.resize(size + sizeof value);
  std::memcpy(bytes.data() + size, &value, sizeof value);
}

void append_text(Bytes& bytes, std::string_view text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
  bytes.push_back(0);
}

template <typename Value>
void append_attribute(Bytes& bytes, std::string_view name, std::string_view type, std::initializer_list<Value> values) {
  append_text(bytes, name);
  append_text(bytes, type);
  append(bytes, static_cast<std::int32_t>(values.size() * sizeof(Value)));
  for (const Value value : values) append(bytes, value);
}

void append_channels(Bytes& bytes, const std::vector<Channel>& channels) {
  Bytes list;
  for (const Channel& channel : channels) {
    append_text(list, channel.name);
    append(list, channel.type);
    append(list, std::uint32_t{0});                                      // not linear to the eye
    for (int axis = 0; axis < 2; ++axis) append(list, std::int32_t{1});  // every pixel
  }
  list.push_back(0);
  append_text(bytes, "channels");
  append_text(bytes, "chlist");
  append(bytes, static_cast<std::int32_t>(list.size()));
  bytes.insert(bytes.end(), list.begin(), list.end());
}

/// Bytes of even places, then those of odd ones, each as its difference from the one before, plus 128.
Bytes differences(const Bytes& raw) {
  Bytes sorted(raw.size());
  const std::size_t half = (raw.size() + 1) / 2;
  for (std::size_t i = 0; i < raw.size(); ++i) sorted[i / 2 + i % 2 * half] = raw[i];
  std::uint8_t before = sorted[0];
  for (std::size_t i = 1; i < sorted.size(); ++i) {
    const std::uint8_t here = sorted[i];
    sorted[i] = static_cast<std::uint8_t>(here - before + 128);
    before = here;
  }
  return sorted;
}

}  // namespace

Bytes begin_file(const std::vector<Channel>& channels, int width, int height) {
  constexpr std::uint32_t kMagic = 20000630, kVersion = 2, kHasLongNames = 0x400;
  std::size_t longest = 0;
  for (const Channel& channel : channels) longest = std::max(longest, channel.name.size());
  if (longest > kLongName) throw Error("EXR: the name of a channel is too long");
  Bytes bytes;
  append(bytes, kMagic);
  append(bytes, longest > kShortName ? kVersion | kHasLongNames : kVersion);
  constexpr std::uint8_t kZip = 3, kIncreasingY = 0;
  append_channels(bytes, channels);
  // Of Rec. 709, which are sRGB's.
  append_attribute(bytes, "chromaticities", "chromaticities",
                   {0.64f, 0.33f, 0.30f, 0.60f, 0.15f, 0.06f, 0.3127f, 0.3290f});
  append_attribute(bytes, "compression", "compression", {kZip});
  append_attribute(bytes, "dataWindow", "box2i", {0, 0, width - 1, height - 1});
  append_attribute(bytes, "displayWindow", "box2i", {0, 0, width - 1, height - 1});
  append_attribute(bytes, "lineOrder", "lineOrder", {kIncreasingY});
  append_attribute(bytes, "pixelAspectRatio", "float", {1.0f});
  append_attribute(bytes, "screenWindowCenter", "v2f", {0.0f, 0.0f});
  append_attribute(bytes, "screenWindowWidth", "float", {1.0f});
  bytes.push_back(0);
  return bytes;
}

Bytes compress(const Bytes& raw) {
  const Bytes sorted = differences(raw);
  uLongf size = compressBound(sorted.size());
  Bytes packed(size);
  if (compress2(packed.data(), &size, sorted.data(), sorted.size(), kLevel) != Z_OK) throw std::bad_alloc();
  if (size >= raw.size()) return raw;
  packed.resize(size);
  return packed;
}

Bytes finish_file(Bytes&& header, std::vector<Bytes>& chunks) {
  constexpr std::size_t kPrefix = 2 * sizeof(std::int32_t);  // of a chunk: its first row, its size
  Bytes bytes = std::move(header);
  std::size_t place = bytes.size() + chunks.size() * sizeof(std::uint64_t), end = place;
  for (const Bytes& chunk : chunks) end += kPrefix + chunk.size();
  bytes.reserve(end);
  for (const Bytes& chunk : chunks) {
    append(bytes, std::uint64_t{place});
    place += kPrefix + chunk.size();
  }
  std::int32_t row = 0;
  for (Bytes& chunk : chunks) {
    append(bytes, row);
    append(bytes, static_cast<std::int32_t>(chunk.size()));
    bytes.insert(bytes.end(), chunk.begin(), chunk.end());
    chunk = {};
    row += kRowsOfChunk;
  }
  return bytes;
}

}  // namespace facemap::exr
