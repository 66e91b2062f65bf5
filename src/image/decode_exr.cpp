#include "image/decode_exr.h"

#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <facemap/error.h>

#include <cstring>

#include "image/exr_header.h"
#include "image/image_limits.h"

namespace facemap {
namespace {

/// Bytes of pixels that a byte of the file may stand for: more than any of the format's compressors reaches.
constexpr std::uint64_t kMostExpanded = 1 << 16;

/// A file in memory.
class ByteStream : public Imf::IStream {
 public:
  explicit ByteStream(std::span<const std::uint8_t> bytes) : IStream("EXR"), bytes_(bytes) {}

  bool read(char to[], int count) override {
    const auto size = static_cast<std::size_t>(count);
    if (at_ > bytes_.size() || size > bytes_.size() - at_) throw Iex::InputExc("it ends too early");
    std::memcpy(to, bytes_.data() + at_, size);
    at_ += size;
    return at_ < bytes_.size();
  }
  std::uint64_t tellg() override { return at_; }
  void seekg(std::uint64_t at) override { at_ = at; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::size_t at_ = 0;
};

template <typename Value>
void add_channel(const std::string& name, Imf::PixelType type, const Imath::Box2i& window, Imf::FrameBuffer& slices,
                 PictureChannels& picture) {
  const auto width = static_cast<std::size_t>(picture.width), height = static_cast<std::size_t>(picture.height);
  picture.channels.push_back({name, std::vector<Value>(width * height)});
  auto& values = std::get<std::vector<Value>>(picture.channels.back().values);
  slices.insert(name, Imf::Slice::Make(type, values.data(), window));
}

/// The header alone, before the library takes memory for what it promises.
Imf::Header read_header(std::span<const std::uint8_t> bytes) {
  constexpr std::size_t kVersion = 4, kBegin = 8;  // places
  ByteStream stream(bytes);
  stream.seekg(kBegin);
  int version = bytes[kVersion] | bytes[kVersion + 1] << 8;
  Imf::Header header;
  header.readFrom(stream, version);
  return header;
}

PictureChannels read(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels) {
  const Imf::Header header = read_header(bytes);
  const Imath::Box2i window = header.dataWindow();
  const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1,
                     height = std::int64_t{window.max.y} - window.min.y + 1;
  check_picture_size(name, static_cast<std::uint64_t>(width), static_cast<std::uint64_t>(height), max_pixels);

  PictureChannels picture{name, static_cast<int>(width), static_cast<int>(height), PictureChannels::Unit::Values, {}};
  const Imf::ChannelList& channels = header.channels();
  std::uint64_t a_pixel = 0;
  for (auto at = channels.begin(); at != channels.end(); ++at) a_pixel += sizeof(float);
  if (a_pixel == 0) refuse_picture(name, "EXR", "it has no channels");
  check_promise(name, a_pixel * static_cast<std::uint64_t>(width * height), bytes.size(), kMostExpanded);

  Imf::FrameBuffer slices;
  for (auto at = channels.begin(); at != channels.end(); ++at) {
    if (at.channel().xSampling != 1 || at.channel().ySampling != 1)
      refuse_picture(name, "EXR", std::string("its channel ") + at.name() + " is subsampled");
    if (at.channel().type == Imf::UINT) {
      add_channel<std::uint32_t>(at.name(), Imf::UINT, window, slices, picture);
    } else {
      add_channel<float>(at.name(), Imf::FLOAT, window, slices, picture);
    }
  }
  constexpr int kNoThreads = 0;
  ByteStream stream(bytes);
  Imf::InputFile file(stream, kNoThreads);
  file.setFrameBuffer(slices);
  file.readPixels(window.min.y, window.max.y);
  return picture;
}

}  // namespace

bool is_exr(std::span<const std::uint8_t> bytes) noexcept {
  return bytes.size() >= 4 && bytes[0] == 0x76 && bytes[1] == 0x2f && bytes[2] == 0x31 && bytes[3] == 0x01;
}

PictureChannels decode_exr(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels) {
  try {
    return read(with_plain_header(bytes, name), name, max_pixels);
  } catch (const Iex::BaseExc& error) {
    refuse_picture(name, "EXR", error.what());
  }
}

}  // namespace facemap
