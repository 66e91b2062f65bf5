#include <cstdlib>
#include <memory>

#include "image/jpeg_errors.h"
#include "image/plane.h"

namespace facemap {
namespace {

/// libjpeg for one picture. See JpegErrors for the rule that the function with setjmp follows.
class JpegWriter {
 public:
  JpegWriter() = default;
  ~JpegWriter() {
    jpeg_destroy_compress(&jpeg_);
    std::free(memory_);
  }
  JpegWriter(const JpegWriter&) = delete;
  JpegWriter& operator=(const JpegWriter&) = delete;

  /// False if it fails: reason() says why.
  bool write(const PlaneView& plane, const std::uint8_t* levels, int quality) {
    jpeg_.err = errors_.install();
    if (setjmp(errors_.jump)) return false;
    jpeg_create_compress(&jpeg_);
    jpeg_mem_dest(&jpeg_, &memory_, &size_);
    set_parameters(plane, quality);
    jpeg_start_compress(&jpeg_, TRUE);
    write_lines(levels);
    jpeg_finish_compress(&jpeg_);
    return true;
  }

  std::vector<std::uint8_t> bytes() const { return {memory_, memory_ + size_}; }
  const char* reason() const { return errors_.reason; }

 private:
  void set_parameters(const PlaneView& plane, int quality) {
    jpeg_.image_width = static_cast<JDIMENSION>(plane.width);
    jpeg_.image_height = static_cast<JDIMENSION>(plane.height);
    jpeg_.input_components = plane.channels;
    jpeg_.in_color_space = plane.channels == 3 ? JCS_RGB : JCS_GRAYSCALE;
    jpeg_set_defaults(&jpeg_);
    jpeg_set_quality(&jpeg_, quality, TRUE);
    for (int k = 0; k < jpeg_.num_components; ++k)
      jpeg_.comp_info[k].h_samp_factor = jpeg_.comp_info[k].v_samp_factor = 1;
    jpeg_.dct_method = JDCT_ISLOW;
    jpeg_.optimize_coding = TRUE;
  }

  void write_lines(const std::uint8_t* levels) {
    const std::size_t stride = std::size_t{jpeg_.image_width} * static_cast<std::size_t>(jpeg_.input_components);
    while (jpeg_.next_scanline < jpeg_.image_height) {
      // libjpeg reads the row and does not write to it.
      JSAMPROW row = const_cast<std::uint8_t*>(levels + jpeg_.next_scanline * stride);
      jpeg_write_scanlines(&jpeg_, &row, 1);
    }
  }

  jpeg_compress_struct jpeg_{};
  JpegErrors errors_;
  unsigned char* memory_ = nullptr;
  unsigned long size_ = 0;
};

}  // namespace

std::vector<std::uint8_t> encode_jpeg(const PlaneView& plane, int quality) {
  const std::span<const std::uint8_t> levels = values_of<std::uint8_t>("JPEG", plane, {1, 3});
  if (quality < 1 || quality > 100) throw Error("JPEG: the quality is not 1 to 100");
  if (plane.width > JPEG_MAX_DIMENSION || plane.height > JPEG_MAX_DIMENSION) {
    throw Error("JPEG: " + std::to_string(plane.width) + "x" + std::to_string(plane.height) +
                " pixels; the format has at most " + std::to_string(JPEG_MAX_DIMENSION) + " a side");
  }
  JpegWriter writer;
  if (!writer.write(plane, levels.data(), quality)) throw Error(std::string("JPEG: ") + writer.reason());
  return writer.bytes();
}

}  // namespace facemap
