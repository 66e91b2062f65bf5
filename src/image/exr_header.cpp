#include "image/exr_header.h"

#include <algorithm>
#include <string_view>

#include "image/image_limits.h"

namespace facemap {
namespace {

constexpr std::size_t kVersion = 4, kBegin = 8;  // places

/// An attribute that OpenEXR needs. It reads as many bytes as the type has, whatever size the file says.
struct Needed {
  std::string_view name, type;
  std::size_t size;
};
constexpr Needed kNeeded[] = {
    {"channels", "chlist", 0},  // it ends with an empty name
    {"compression", "compression", 1}, {"dataWindow", "box2i", 16},      {"displayWindow", "box2i", 16},
    {"lineOrder", "lineOrder", 1},     {"pixelAspectRatio", "float", 4}, {"screenWindowCenter", "v2f", 8},
    {"screenWindowWidth", "float", 4}, {"tiles", "tiledesc", 9},
};

/// Goes from attribute to attribute: name, type (both end with a zero), size (four bytes, lowest first), value.
class Attributes {
 public:
  Attributes(std::vector<std::uint8_t>& bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  void make_plain() {
    while (true) {
      const std::string_view name = next_text();
      if (name.empty()) return;
      const std::size_t type_begin = at_;
      const std::string_view type = next_text();
      const std::size_t size = next_size(), end = at_ + size;
      const auto needed =
          std::find_if(std::begin(kNeeded), std::end(kNeeded), [&](const Needed& one) { return one.name == name; });
      if (needed == std::end(kNeeded)) {
        if (type.empty()) refuse_picture(name_, "EXR", "an attribute has no type");
        std::fill_n(bytes_.begin() + static_cast<std::ptrdiff_t>(type_begin), type.size(), std::uint8_t{'?'});
      } else if (type != needed->type || size != (needed->size ? needed->size : channel_list_size())) {
        refuse_picture(name_, "EXR", "its attribute " + std::string(name) + " is of another type or size");
      }
      at_ = end;
    }
  }

 private:
  /// Up to and with the empty name.
  std::size_t channel_list_size() {
    constexpr std::size_t kChannel = 16;  // bytes behind a channel's name
    const std::size_t begin = at_;
    while (!next_text().empty()) at_ += std::min(kChannel, bytes_.size() - at_);
    return at_ - begin;
  }

  std::string_view next_text() {
    const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(at_);
    const auto end = std::find(begin, bytes_.end(), std::uint8_t{0});
    if (end == bytes_.end()) refuse_picture(name_, "EXR", "it ends too early");
    constexpr std::size_t kLongest = 255;
    const auto size = static_cast<std::size_t>(end - begin);
    if (size > kLongest) refuse_picture(name_, "EXR", "a name in its header is too long");
    const std::string_view text(reinterpret_cast<const char*>(bytes_.data() + at_), size);
    at_ += size + 1;
    return text;
  }

  std::size_t next_size() {
    constexpr std::size_t kSizeBytes = 4;
    std::size_t size = 0;
    if (bytes_.size() - at_ < kSizeBytes) refuse_picture(name_, "EXR", "it ends too early");
    for (std::size_t i = 0; i < kSizeBytes; ++i) size |= std::size_t{bytes_[at_ + i]} << (8 * i);
    at_ += kSizeBytes;
    if (size > bytes_.size() - at_) refuse_picture(name_, "EXR", "it ends too early");
    return size;
  }

  std::vector<std::uint8_t>& bytes_;
  const std::string& name_;
  std::size_t at_ = kBegin;
};

}  // namespace

std::vector<std::uint8_t> with_plain_header(std::span<const std::uint8_t> bytes, const std::string& name) {
  constexpr unsigned kDeep = 0x08, kSeveralParts = 0x10;
  if (bytes.size() < kBegin) refuse_picture(name, "EXR", "it ends too early");
  if (bytes[kVersion + 1] & (kDeep | kSeveralParts))
    refuse_picture(name, "EXR", "files of several parts or of deep pixels are not read");
  std::vector<std::uint8_t> plain(bytes.begin(), bytes.end());
  Attributes(plain, name).make_plain();
  return plain;
}

}  // namespace facemap
