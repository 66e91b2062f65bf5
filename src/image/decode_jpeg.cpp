#include "image/decode_jpeg.h"

#include <facemap/error.h>

#include "image/image_limits.h"
#include "image/jpeg_errors.h"

namespace facemap {
namespace {

// A block of 64 values takes 1 bit at least, and sampling factors of 4 by 4 leave 2 blocks for 32 x 32 pixels: fewer
// pixels a byte than this.
constexpr std::uint64_t kMostPixelsAByte = 4096;

/// Each scan goes over the whole picture; files of thousands of empty ones are made to keep a reader busy. Encoders
/// write 10 or so.
constexpr int kMostScans = 100;

/// libjpeg for one picture. See JpegErrors for the rule that the functions with setjmp follow.
class JpegReader {
 public:
  explicit JpegReader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }
  JpegReader(const JpegReader&) = delete;
  JpegReader& operator=(const JpegReader&) = delete;

  /// False, here and below, if it fails: reason() says why.
  bool read_header() {
    jpeg_.err = errors_.install();
    if (setjmp(errors_.jump)) return false;
    jpeg_create_decompress(&jpeg_);
    jpeg_.progress = &progress_;
    progress_.progress_monitor = &check_scans;
    jpeg_mem_src(&jpeg_, bytes_.data(), bytes_.size());
    jpeg_read_header(&jpeg_, TRUE);
    return true;
  }

  /// Fills height rows of RGBA.
  bool read_rows(std::uint8_t* rows) {
    if (setjmp(errors_.jump)) return false;
    jpeg_.out_color_space = is_cmyk() ? JCS_CMYK : JCS_EXT_RGBA;
    jpeg_.dct_method = JDCT_ISLOW;
    jpeg_.do_fancy_upsampling = TRUE;
    jpeg_.do_block_smoothing = FALSE;
    jpeg_start_decompress(&jpeg_);
    read_lines(rows);
    jpeg_finish_decompress(&jpeg_);
    return true;
  }

  std::uint32_t width() const { return jpeg_.image_width; }
  std::uint32_t height() const { return jpeg_.image_height; }
  bool is_arithmetic() const { return jpeg_.arith_code; }
  bool has_known_colours() const { return jpeg_.jpeg_color_space != JCS_UNKNOWN; }
  bool is_cmyk() const { return jpeg_.jpeg_color_space == JCS_CMYK || jpeg_.jpeg_color_space == JCS_YCCK; }
  bool is_inverted() const { return jpeg_.saw_Adobe_marker; }  ///< of CMYK: 255 is no ink
  const char* reason() const { return errors_.reason; }

 private:
  static void check_scans(j_common_ptr codec) {
    if (reinterpret_cast<j_decompress_ptr>(codec)->input_scan_number <= kMostScans) return;
    JpegErrors::fail(codec, "it has more than 100 scans");
  }

  void read_lines(std::uint8_t* rows) {
    const std::size_t stride = std::size_t{4} * jpeg_.output_width;
    while (jpeg_.output_scanline < jpeg_.output_height) {
      JSAMPROW row = rows + jpeg_.output_scanline * stride;
      jpeg_read_scanlines(&jpeg_, &row, 1);
    }
  }

  std::span<const std::uint8_t> bytes_;
  jpeg_decompress_struct jpeg_{};
  jpeg_progress_mgr progress_{};
  JpegErrors errors_;
};

/// Light that goes through the inks, in place: RGBA of CMYK.
void rgba_from_cmyk(std::vector<std::uint8_t>& pixels, bool is_inverted) {
  const unsigned flip = is_inverted ? 0 : 255;
  for (std::size_t i = 0; i < pixels.size(); i += 4) {
    const unsigned key = pixels[i + 3] ^ flip;
    for (std::size_t k = i; k < i + 3; ++k)
      pixels[k] = static_cast<std::uint8_t>(((pixels[k] ^ flip) * key + 127) / 255);
    pixels[i + 3] = 255;
  }
}

}  // namespace

bool is_jpeg(std::span<const std::uint8_t> bytes) noexcept {
  return bytes.size() >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff;
}

DecodedImage decode_jpeg(std::span<const std::uint8_t> bytes, const std::string& name, std::uint64_t max_pixels) {
  JpegReader reader(bytes);
  if (!reader.read_header()) refuse_picture(name, "JPEG", reader.reason());
  if (reader.is_arithmetic()) refuse_picture(name, "JPEG", "it has arithmetic codes instead of Huffman's");
  if (!reader.has_known_colours()) refuse_picture(name, "JPEG", "its channels are neither grey, nor colours, nor inks");
  check_picture_size(name, reader.width(), reader.height(), max_pixels);
  check_promise(name, std::uint64_t{reader.width()} * reader.height(), bytes.size(), kMostPixelsAByte);
  DecodedImage image;
  image.width = static_cast<int>(reader.width());
  image.height = static_cast<int>(reader.height());
  image.rgba.resize(std::size_t{4} * reader.width() * reader.height());
  if (!reader.read_rows(image.rgba.data())) refuse_picture(name, "JPEG", reader.reason());
  if (reader.is_cmyk()) rgba_from_cmyk(image.rgba, reader.is_inverted());
  return image;
}

}  // namespace facemap
