#include "image/decode_png.h"

#include <facemap/error.h>
#include <png.h>

#include <algorithm>
#include <bit>
#include <csetjmp>
#include <cstring>

#include "image/image_limits.h"
#include "image/png_chunks.h"

namespace facemap {
namespace {

constexpr std::uint64_t kMostInflated = 1032;  ///< bytes that DEFLATE makes of one, at most

/// libpng for one picture. It reports errors by jumping back to where setjmp stood: the two functions that call setjmp,
/// and all that libpng calls of ours, hold nothing with a destructor.
class PngReader {
 public:
  explicit PngReader(std::span<const std::uint8_t> bytes) : rest_(bytes) {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, &fail, &ignore_warning);
    if (png_) info_ = png_create_info_struct(png_);
  }
  ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngReader(const PngReader&) = delete;
  PngReader& operator=(const PngReader&) = delete;

  /// False, here and below, if it fails: reason() says why.
  bool read_header() {
    if (!png_ || !info_) return false;
    if (setjmp(png_jmpbuf(png_))) return false;
    png_set_read_fn(png_, this, &read_bytes);
    png_set_benign_errors(png_, 1);
    skip_colour_chunks();
    png_read_info(png_, info_);
    return true;
  }

  /// Fills height rows of `stride` bytes: RGBA of `bits` bits, of the machine's byte order.
  bool read_rows(std::uint8_t* rows, std::size_t stride, int bits) {
    if (setjmp(png_jmpbuf(png_))) return false;
    ask_for_rgba(bits);
    if (png_get_rowbytes(png_, info_) != stride) png_error(png_, "rows are of another size");
    read_passes(rows, stride);
    png_read_end(png_, nullptr);
    return true;
  }

  std::uint32_t width() const { return png_get_image_width(png_, info_); }
  std::uint32_t height() const { return png_get_image_height(png_, info_); }
  std::uint64_t packed_bytes() const {
    return height() * (1 + (std::uint64_t{width()} * png_get_channels(png_, info_) * bit_depth() + 7) / 8);
  }
  const char* reason() const { return reason_; }

 private:
  static void fail(png_structp png, png_const_charp message) {
    auto* const self = static_cast<PngReader*>(png_get_error_ptr(png));
    std::strncpy(self->reason_, message, sizeof self->reason_ - 1);
    png_longjmp(png, 1);
  }

  static void ignore_warning(png_structp, png_const_charp) {}

  static void read_bytes(png_structp png, png_bytep to, std::size_t size) {
    auto* const self = static_cast<PngReader*>(png_get_io_ptr(png));
    if (size > self->rest_.size()) png_error(png, "it ends too early");
    std::memcpy(to, self->rest_.data(), size);
    self->rest_ = self->rest_.subspan(size);
  }

  unsigned bit_depth() const { return png_get_bit_depth(png_, info_); }

  /// What they say is ignored, so that a broken profile does no harm.
  void skip_colour_chunks() {
    static constexpr png_byte kChunks[] = "gAMA\0cHRM\0iCCP\0sRGB\0tEXt\0zTXt\0iTXt\0eXIf";
    png_set_keep_unknown_chunks(png_, PNG_HANDLE_CHUNK_NEVER, kChunks, sizeof kChunks / 5);
  }

  void ask_for_rgba(int bits) {
    png_set_expand(png_);  // palettes, fewer bits, tRNS
    if (bits == 8) {
      png_set_scale_16(png_);
    } else {
      png_set_expand_16(png_);
      if (std::endian::native == std::endian::little) png_set_swap(png_);
    }
    png_set_gray_to_rgb(png_);
    png_set_add_alpha(png_, 0xffff, PNG_FILLER_AFTER);
    passes_ = png_set_interlace_handling(png_);
    png_read_update_info(png_, info_);
  }

  void read_passes(std::uint8_t* rows, std::size_t stride) {
    const std::uint32_t count = height();
    for (int pass = 0; pass < passes_; ++pass) {
      for (std::uint32_t y = 0; y < count; ++y) png_read_row(png_, rows + y * stride, nullptr);
    }
  }

  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
  std::span<const std::uint8_t> rest_;
  int passes_ = 1;
  char reason_[160] = "not enough memory";
};

/// Both depths: `Image` has width, height and rgba.
template <typename Image>
Image decode(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels) {
  using Level = typename decltype(Image::rgba)::value_type;
  PngReader reader(bytes);
  if (!reader.read_header()) refuse_picture(name, "PNG", reader.reason());
  check_picture_size(name, reader.width(), reader.height(), max_pixels);
  check_promise(name, reader.packed_bytes(), bytes.size(), kMostInflated);
  Image image;
  image.width = static_cast<int>(reader.width());
  image.height = static_cast<int>(reader.height());
  image.rgba.resize(std::size_t{4} * reader.width() * reader.height());
  const std::size_t stride = std::size_t{4} * reader.width() * sizeof(Level);
  if (!reader.read_rows(reinterpret_cast<std::uint8_t*>(image.rgba.data()), stride, 8 * sizeof(Level)))
    refuse_picture(name, "PNG", reader.reason());
  return image;
}

}  // namespace

bool is_png(std::span<const std::uint8_t> bytes) noexcept {
  return bytes.size() >= sizeof png::kSignature &&
         std::equal(std::begin(png::kSignature), std::end(png::kSignature), bytes.begin());
}

bool is_png_16(std::span<const std::uint8_t> bytes) noexcept {
  constexpr std::size_t kDepth = 24;  // its place
  return is_png(bytes) && bytes.size() > kDepth && bytes[kDepth] == 16;
}

DecodedImage decode_png(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels) {
  DecodedImage image = decode<DecodedImage>(bytes, name, max_pixels);
  for (std::size_t i = 3; i < image.rgba.size() && !image.has_alpha; i += 4) image.has_alpha = image.rgba[i] != 255;
  return image;
}

DecodedImage16 decode_png_16(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels) {
  return decode<DecodedImage16>(bytes, name, max_pixels);
}

}  // namespace facemap
