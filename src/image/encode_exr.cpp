#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>

#include "image/exr_file.h"
#include "image/plane.h"
#include "parallel/executor.h"

namespace facemap {
namespace {

constexpr float kLargestHalf = 65504;
constexpr std::size_t kMostChunkBytes = std::size_t{1} << 30;  ///< sizes in the file have 31 bits

/// A channel of the file, and where its values are.
struct Source {
  exr::Channel channel;
  const PlaneView* plane;
  std::size_t offset;  ///< of the first value
};

exr::PixelType type_of(const ExrLayers& layers) {
  const bool is_half = layers.storage == ExrLayers::Storage::Half;
  if (std::holds_alternative<std::span<const float>>(layers.plane.values)) {
    return is_half ? exr::PixelType::Half : exr::PixelType::Float;
  }
  if (is_half) throw Error("EXR: whole numbers are not stored as half");
  return exr::PixelType::Uint;
}

void check(const ExrLayers& layers, const PlaneView& first) {
  if (layers.plane.width != first.width || layers.plane.height != first.height)
    throw Error("EXR: the planes are of different sizes");
  check_plane("EXR", layers.plane);
  if (layers.names.size() != static_cast<std::size_t>(layers.plane.channels))
    throw Error("EXR: a plane has not as many names as channels");
}

/// The channels of all layers in the order of their names.
std::vector<Source> sources_of(std::span<const ExrLayers> layers) {
  std::vector<Source> sources;
  for (const ExrLayers& one : layers) {
    check(one, layers[0].plane);
    for (std::size_t k = 0; k < one.names.size(); ++k) {
      sources.push_back({{one.names[k], type_of(one)}, &one.plane, k});
    }
  }
  const auto name = [](const Source& source) -> const std::string& { return source.channel.name; };
  std::sort(sources.begin(), sources.end(), [&](const Source& a, const Source& b) { return name(a) < name(b); });
  const auto same = [&](const Source& a, const Source& b) { return name(a) == name(b); };
  if (name(sources[0]).empty() || std::adjacent_find(sources.begin(), sources.end(), same) != sources.end())
    throw Error("EXR: a layer's name is empty or there twice");
  return sources;
}

std::uint16_t half_bits(float value) {
  if (std::isfinite(value)) value = std::clamp(value, -kLargestHalf, kLargestHalf);
  return half(value).bits();
}

template <typename Stored, typename Value, typename Convert>
std::uint8_t* put(std::span<const Value> row, std::size_t step, std::uint8_t* to, const Convert& convert) {
  for (std::size_t i = 0; i < row.size(); i += step, to += sizeof(Stored)) {
    const Stored stored = convert(row[i]);
    std::memcpy(to, &stored, sizeof stored);
  }
  return to;
}

/// Writes a row of a channel and returns what follows it.
std::uint8_t* put_row(const Source& source, std::size_t y, std::uint8_t* to) {
  const auto step = static_cast<std::size_t>(source.plane->channels);
  const std::size_t stride = static_cast<std::size_t>(source.plane->width) * step;
  const auto put_values = [&](const auto& values) {
    const auto row = values.subspan(y * stride + source.offset, stride - source.offset);
    using Value = std::remove_const_t<typename std::remove_reference_t<decltype(values)>::element_type>;
    if constexpr (std::is_same_v<Value, float>) {
      if (source.channel.type == exr::PixelType::Half) {
        return put<std::uint16_t, float>(row, step, to, half_bits);
      }
      return put<float, float>(row, step, to, [](float value) { return value; });
    } else {
      return put<std::uint32_t, Value>(row, step, to, [](Value value) { return static_cast<std::uint32_t>(value); });
    }
  };
  return std::visit(put_values, source.plane->values);
}

}  // namespace

std::vector<std::uint8_t> encode_exr(std::span<const ExrLayers> layers, int threads) {
  if (layers.empty()) throw Error("EXR: there are no layers");
  const std::vector<Source> sources = sources_of(layers);
  const int width = layers[0].plane.width, height = layers[0].plane.height;
  std::vector<exr::Channel> channels;
  std::size_t row_bytes = 0;
  for (const Source& source : sources) {
    channels.push_back(source.channel);
    row_bytes += static_cast<std::size_t>(width) * exr::size_of(source.channel.type);
  }
  if (row_bytes > kMostChunkBytes / exr::kRowsOfChunk) throw Error("EXR: the planes are too wide");
  std::vector<std::vector<std::uint8_t>> chunks((static_cast<std::size_t>(height) + exr::kRowsOfChunk - 1) /
                                                exr::kRowsOfChunk);
  Executor(chunks.size() == 1 ? 1 : threads).for_each(chunks.size(), [&](std::size_t chunk, int) {
    const std::size_t first = chunk * exr::kRowsOfChunk;
    const std::size_t end = std::min(static_cast<std::size_t>(height), first + exr::kRowsOfChunk);
    std::vector<std::uint8_t> raw((end - first) * row_bytes);
    std::uint8_t* to = raw.data();
    for (std::size_t y = first; y < end; ++y) {
      for (const Source& source : sources) to = put_row(source, y, to);
    }
    chunks[chunk] = exr::compress(raw);
  });
  return exr::finish_file(exr::begin_file(channels, width, height), chunks);
}

}  // namespace facemap
