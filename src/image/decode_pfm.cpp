#include "image/decode_pfm.h"

#include <facemap/error.h>

#include <bit>
#include <charconv>
#include <string_view>

#include "image/image_limits.h"

namespace facemap {
namespace {

bool is_space(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }

/// The header's words, one after the other.
class Words {
 public:
  Words(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  std::string_view next() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_space(text_[at_])) ++at_;
    if (at_ == text_.size()) refuse_picture(name_, "PFM", "it ends too early");
    return text_.substr(begin, at_ - begin);
  }

  template <typename Number>
  Number next_number() {
    const std::string_view word = next();
    Number number{};
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size())
      refuse_picture(name_, "PFM", "its header is not three numbers");
    return number;
  }

  /// What follows the one space after the last word.
  std::size_t data_begin() const { return at_ + 1; }

 private:
  std::string_view text_;
  const std::string& name_;
  std::size_t at_ = 0;
};

float float_at(const std::uint8_t* at, bool is_little) {
  std::uint32_t bits = 0;
  for (unsigned i = 0; i < 4; ++i) bits |= std::uint32_t{at[i]} << (is_little ? 8 * i : 24 - 8 * i);
  return std::bit_cast<float>(bits);
}

}  // namespace

bool is_pfm(std::span<const std::uint8_t> bytes) noexcept {
  return bytes.size() >= 3 && bytes[0] == 'P' && (bytes[1] == 'F' || bytes[1] == 'f') &&
         is_space(static_cast<char>(bytes[2]));
}

PictureChannels decode_pfm(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels) {
  Words words({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name);
  const std::size_t channels = words.next() == "PF" ? 3 : 1;
  const auto width = words.next_number<std::uint32_t>(), height = words.next_number<std::uint32_t>();
  const bool is_little = words.next_number<double>() < 0;
  check_picture_size(name, width, height, max_pixels);
  const std::size_t pixels = std::size_t{width} * height, begin = words.data_begin();
  if ((bytes.size() - begin) / (4 * channels) < pixels) refuse_picture(name, "PFM", "it ends too early");

  PictureChannels picture{name, static_cast<int>(width), static_cast<int>(height), PictureChannels::Unit::Values, {}};
  const char* const names[] = {"B", "G", "R"};
  for (std::size_t k = 0; k < channels; ++k) {
    const std::size_t channel = channels - 1 - k;  // by name
    std::vector<float> values(pixels);
    for (std::size_t i = 0; i < pixels; ++i) {
      const std::size_t y = height - 1 - i / width;  // the lowest row is first
      const std::size_t from = (y * width + i % width) * channels + channel;
      values[i] = float_at(bytes.data() + begin + 4 * from, is_little);
    }
    picture.channels.push_back({channels == 1 ? "Y" : names[k], std::move(values)});
  }
  return picture;
}

}  // namespace facemap
