#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfOutputFile.h>
#include <ImfStandardAttributes.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <list>

#include "image/plane.h"

namespace facemap {
namespace {

constexpr float kLargestHalf = 65504;

/// A file in memory.
class ByteStream : public Imf::OStream {
 public:
  ByteStream() : OStream("EXR") {}

  void write(const char bytes[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (bytes_.size() < at_ + size) bytes_.resize(at_ + size);
    std::memcpy(bytes_.data() + at_, bytes, size);
    at_ += size;
  }
  std::uint64_t tellp() override { return at_; }
  void seekp(std::uint64_t at) override { at_ = at; }

  std::vector<std::uint8_t> take() { return std::move(bytes_); }

 private:
  std::vector<std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

half to_half(float value) {
  if (std::isfinite(value)) value = std::clamp(value, -kLargestHalf, kLargestHalf);
  return value;
}

/// Gathers header and slices, and values that had to be converted.
class ExrWriter {
 public:
  ExrWriter(int width, int height) : width_(width), height_(height) {}

  void add(const ExrLayers& layers) {
    if (layers.plane.width != width_ || layers.plane.height != height_)
      throw Error("EXR: the planes are of different sizes");
    check_plane("EXR", layers.plane);
    if (layers.names.size() != static_cast<std::size_t>(layers.plane.channels))
      throw Error("EXR: a plane has not as many names as channels");
    std::visit([&](const auto& values) { add_values(layers, values); }, layers.plane.values);
  }

  std::vector<std::uint8_t> encode() {
    const Imath::Box2i window({0, 0}, {width_ - 1, height_ - 1});
    Imf::Header header(window, window, 1, {0, 0}, 1, Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
    header.channels() = channels_;
    Imf::addChromaticities(header, Imf::Chromaticities());  // of Rec. 709, which are sRGB's
    ByteStream stream;
    {
      constexpr int kNoThreads = 0;
      Imf::OutputFile file(stream, header, kNoThreads);
      file.setFrameBuffer(slices_);
      file.writePixels(height_);
    }  // writes the table of lines
    return stream.take();
  }

 private:
  void add_values(const ExrLayers& layers, std::span<const float> values) {
    if (layers.storage == ExrLayers::Storage::Exact) return add_slices(layers, Imf::FLOAT, values.data());
    halves_.emplace_back(values.size());
    std::transform(values.begin(), values.end(), halves_.back().begin(), to_half);
    add_slices(layers, Imf::HALF, halves_.back().data());
  }

  template <typename Integer>
  void add_values(const ExrLayers& layers, std::span<const Integer> values) {
    if (layers.storage == ExrLayers::Storage::Half) throw Error("EXR: whole numbers are not stored as half");
    if constexpr (sizeof(Integer) == sizeof(std::uint32_t)) return add_slices(layers, Imf::UINT, values.data());
    integers_.emplace_back(values.begin(), values.end());
    add_slices(layers, Imf::UINT, integers_.back().data());
  }

  template <typename Value>
  void add_slices(const ExrLayers& layers, Imf::PixelType type, const Value* values) {
    const std::size_t pixel = sizeof(Value) * layers.names.size(), row = pixel * static_cast<std::size_t>(width_);
    for (const std::string& name : layers.names) {
      if (name.empty() || channels_.findChannel(name)) throw Error("EXR: a layer's name is empty or there twice");
      channels_.insert(name, Imf::Channel(type));
      // OpenEXR reads the values and does not write to them.
      char* const first = const_cast<char*>(reinterpret_cast<const char*>(values++));
      slices_.insert(name, Imf::Slice(type, first, pixel, row));
    }
  }

  int width_, height_;
  Imf::ChannelList channels_;
  Imf::FrameBuffer slices_;
  std::list<std::vector<half>> halves_;
  std::list<std::vector<std::uint32_t>> integers_;
};

}  // namespace

std::vector<std::uint8_t> encode_exr(std::span<const ExrLayers> layers) {
  if (layers.empty()) throw Error("EXR: there are no layers");
  try {
    ExrWriter writer(layers[0].plane.width, layers[0].plane.height);
    for (const ExrLayers& one : layers) writer.add(one);
    return writer.encode();
  } catch (const Iex::BaseExc& error) {
    throw Error(std::string("EXR: ") + error.what());
  }
}

}  // namespace facemap
