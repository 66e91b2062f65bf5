#include <facemap/error.h>
#include <facemap/image.h>
#include <png.h>

#include <csetjmp>
#include <memory>
#include <new>
#include <vector>

#include "render/atomic_file.h"

namespace facemap {
namespace {

/// Measured on the four generated scenes at 1024 x 1024, sums: level 2 without a filter 85 ms and 1853 kB, level 3
/// with Sub 128 ms and 1815 kB, level 6 with Sub 298 ms and 1791 kB. Renders are hard edges on plain ground.
constexpr int kCompressionLevel = 2;
constexpr int kFilter = PNG_FILTER_NONE;

/// libpng reports errors by a long jump: every object that a jump may pass lives outside the function that sets it.
struct Encoder {
  std::vector<std::uint8_t> bytes;
  std::string reason;
  bool out_of_memory = false;
  png_structp png = nullptr;
  png_infop info = nullptr;

  Encoder() = default;
  Encoder(const Encoder&) = delete;
  Encoder& operator=(const Encoder&) = delete;
  ~Encoder() { png_destroy_write_struct(&png, &info); }

  static void append(png_structp png, png_bytep bytes, png_size_t size) {
    auto* self = static_cast<Encoder*>(png_get_io_ptr(png));
    try {
      self->bytes.insert(self->bytes.end(), bytes, bytes + size);
      return;
    } catch (const std::bad_alloc&) {
      self->out_of_memory = true;
    }
    png_error(png, "out of memory");
  }

  static void flush(png_structp) {}
  static void ignore_warning(png_structp, png_const_charp) {}

  static void keep_reason(png_structp png, png_const_charp reason) {
    static_cast<Encoder*>(png_get_error_ptr(png))->reason = reason;
    png_longjmp(png, 1);
  }
};

void fill_row(const Image& image, int y, std::uint8_t* row) {
  const Color* pixel = image.pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width);
  for (int x = 0; x < image.width; ++x, row += 3) {
    const std::uint32_t rgb = pixel[x].to_24_bit();
    row[0] = static_cast<std::uint8_t>(rgb >> 16);
    row[1] = static_cast<std::uint8_t>(rgb >> 8);
    row[2] = static_cast<std::uint8_t>(rgb);
  }
}

/// False if libpng refused; the reason is then in `encoder`.
bool encode(const Image& image, Encoder& encoder, std::uint8_t* row) {
  if (setjmp(png_jmpbuf(encoder.png))) return false;
  png_set_write_fn(encoder.png, &encoder, Encoder::append, Encoder::flush);
  png_set_compression_level(encoder.png, kCompressionLevel);
  png_set_filter(encoder.png, PNG_FILTER_TYPE_BASE, kFilter);
  png_set_IHDR(encoder.png, encoder.info, static_cast<png_uint_32>(image.width), static_cast<png_uint_32>(image.height),
               8, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_set_sRGB(encoder.png, encoder.info, PNG_sRGB_INTENT_PERCEPTUAL);
  png_write_info(encoder.png, encoder.info);
  for (int y = 0; y < image.height; ++y) {
    fill_row(image, y, row);
    png_write_row(encoder.png, row);
  }
  png_write_end(encoder.png, encoder.info);
  return true;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.width <= 0 || image.height <= 0 || image.pixels.size() != pixels)
    throw Error("PNG: the image has no pixels");
  Encoder encoder;
  encoder.png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &encoder, Encoder::keep_reason, Encoder::ignore_warning);
  if (encoder.png) encoder.info = png_create_info_struct(encoder.png);
  if (!encoder.info) throw std::bad_alloc();
  std::vector<std::uint8_t> row(3 * static_cast<std::size_t>(image.width));
  if (!encode(image, encoder, row.data())) {
    if (encoder.out_of_memory) throw std::bad_alloc();
    throw Error("PNG: " + encoder.reason);
  }
  return std::move(encoder.bytes);
}

void write_png(const Image& image, const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = encode_png(image);
  write_whole_file(path, bytes.data(), bytes.size());
}

Picture24 read_png(const std::filesystem::path& path) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  const std::unique_ptr<png_image, void (*)(png_imagep)> guard(&png, png_image_free);
  const auto fail = [&](const std::string& reason) { throw Error(path.string() + ": cannot read PNG: " + reason); };

  if (!png_image_begin_read_from_file(&png, path.c_str())) fail(png.message);
  if (png.format != PNG_FORMAT_RGB) fail("it is not of 8-bit RGB");
  std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(png));
  if (!png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr)) fail(png.message);

  Picture24 picture;
  picture.width = static_cast<int>(png.width);
  picture.height = static_cast<int>(png.height);
  picture.pixels.reserve(bytes.size() / 3);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    picture.pixels.push_back(std::uint32_t{bytes[i]} << 16 | std::uint32_t{bytes[i + 1]} << 8 | bytes[i + 2]);
  }
  return picture;
}

}  // namespace facemap
