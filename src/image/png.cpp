#include <facemap/atomic_file.h>
#include <facemap/error.h>
#include <facemap/image.h>
#include <png.h>
#include <zlib.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "image/pixel_deflate.h"
#include "image/png_chunks.h"
#include "image/srgb.h"
#include "parallel/executor.h"

namespace facemap {
namespace {

constexpr std::size_t kBandBytes = std::size_t{1} << 18;  ///< about, of rows that a thread compresses at a time

/// Makes bands. One a thread: it keeps its memory.
class BandMaker {
 public:
  png::Band make(const Image& image, Transfer transfer, std::size_t first_row, std::size_t end_row) {
    const auto width = static_cast<std::size_t>(image.width);
    const std::size_t stride = 1 + 3 * width, above = first_row > 0 ? 1 : 0;
    rows_.resize((above + end_row - first_row) * stride + PixelDeflater::kPadding);
    const auto encode = transfer == Transfer::Srgb ? encode_srgb : encode_linear;
    for (std::size_t y = first_row - above; y < end_row; ++y) {
      std::uint8_t* const row = rows_.data() + (y + above - first_row) * stride;
      row[0] = PNG_FILTER_VALUE_NONE;
      encode(image.pixels.data() + y * width, width, row + 1);
    }
    const std::uint8_t* const first = rows_.data() + above * stride;
    png::Band band;
    band.bytes = (end_row - first_row) * stride;
    band.adler = adler32_z(1, first, band.bytes);
    png::begin_chunk(band.chunk, "IDAT");
    if (first_row == 0) band.chunk.insert(band.chunk.end(), {0x78, 0x01});  // zlib's header: 32 KiB window, fastest
    const bool is_last = end_row == static_cast<std::size_t>(image.height);
    deflater_.compress(first, end_row - first_row, width, above > 0, is_last, band.chunk);
    if (!is_last) png::finish_chunk(band.chunk, 0);
    return band;
  }

 private:
  std::vector<std::uint8_t> rows_;  ///< as PNG has them, the one above the band's first, too
  PixelDeflater deflater_;
};

std::vector<png::Band> make_bands(const Image& image, Transfer transfer, int threads) {
  const auto height = static_cast<std::size_t>(image.height);
  const std::size_t rows =
      std::clamp<std::size_t>(kBandBytes / (1 + 3 * static_cast<std::size_t>(image.width)), 1, height);
  std::vector<png::Band> bands((height + rows - 1) / rows);
  const Executor executor(bands.size() == 1 ? 1 : threads);
  std::vector<std::unique_ptr<BandMaker>> makers(static_cast<std::size_t>(executor.threads()));
  executor.for_each(bands.size(), [&](std::size_t i, int worker) {
    std::unique_ptr<BandMaker>& maker = makers[static_cast<std::size_t>(worker)];
    if (!maker) maker = std::make_unique<BandMaker>();
    bands[i] = maker->make(image, transfer, i * rows, std::min(height, (i + 1) * rows));
  });
  return bands;
}

}  // namespace

std::vector<std::uint8_t> encode_png(const Image& image, int threads, const DisplayTransform& display) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.width <= 0 || image.height <= 0 || image.pixels.size() != pixels)
    throw Error("PNG: the image has no pixels");
  const Image shown = display.keeps_light() ? Image() : displayed(image, display, threads);
  std::vector<png::Band> bands = make_bands(display.keeps_light() ? image : shown, display.transfer, threads);
  std::vector<std::uint8_t> bytes = png::begin_file(image.width, image.height, 8, PNG_COLOR_TYPE_RGB);
  png::append_transfer(bytes, display.transfer);
  png::append_bands(bytes, bands);
  return bytes;
}

void write_png(const Image& image, const std::filesystem::path& path, int threads, const DisplayTransform& display) {
  const std::vector<std::uint8_t> bytes = encode_png(image, threads, display);
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
