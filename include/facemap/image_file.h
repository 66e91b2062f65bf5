#pragma once

#include <facemap/image.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace facemap {

/// Numbers of a picture that somebody else owns, row by row from the top: channel c of pixel (x, y) is element
/// (y * width + x) * channels + c.
struct PlaneView {
  using Values = std::variant<std::span<const float>, std::span<const std::int32_t>, std::span<const std::uint16_t>,
                              std::span<const std::uint8_t>>;

  int width = 0;
  int height = 0;
  int channels = 1;
  Values values;
};

/// The colours of an image, linear R, G, B, and its planes; it must outlive them. Throw Error if it has no such plane.
PlaneView color_plane(const Image& image);
PlaneView plane_view(const Image& image, Plane plane);

/// A plane for the eye, as docs/output.md says: near is white, directions and ids are colours, no face is black.
Image plane_picture(const Image& image, Plane plane);

/// The colours in levels, three a pixel: clamped to 0..1, rounded to nearest; NaN is 0. `threads` work on them (0: as
/// many as the process may run at once); the levels do not depend on them.
std::vector<std::uint8_t> levels_8(const Image& image, Transfer transfer = Transfer::Srgb);  ///< as of write_png()
std::vector<std::uint16_t> levels_16(const Image& image, Transfer transfer, int threads = 0);

// The bytes of a file. The same planes give the same bytes whatever the threads, and the same pixels on every machine.
// All throw Error if a plane has other dimensions than it says, no pixels, or a type or number of channels that the
// format has not.

/// PNG of 16 bits: uint16 levels of 1 (grey), 2 (grey, alpha), 3 (RGB) or 4 (RGBA) channels.
std::vector<std::uint8_t> encode_png_16(const PlaneView& plane, Transfer transfer, int threads = 0);

/// JPEG: uint8 sRGB levels of 1 or 3 channels, at most 65,500 pixels a side; quality 1..100; chroma is not subsampled.
std::vector<std::uint8_t> encode_jpeg(const PlaneView& plane, int quality = 90);

/// PFM: floats of 1 or 3 channels, little endian; the format's rows begin at the bottom.
std::vector<std::uint8_t> encode_pfm(const PlaneView& plane);

/// NumPy's NPY, version 1.0: any type, [H,W] for one channel and [H,W,C] for more, or always.
enum class NpyShape { ByChannels, AlwaysThree };
std::vector<std::uint8_t> encode_npy(const PlaneView& plane, NpyShape shape = NpyShape::ByChannels);

/// A plane as layers of an EXR file.
struct ExrLayers {
  enum class Storage {
    Exact,  ///< float as float32, integers as uint32: -1 is 4294967295
    Half,   ///< float16: finite values beyond 65504 become 65504; floats alone
  };

  std::vector<std::string> names;  ///< one a channel: "R", "G", "B", "depth.Z", "normal.X"
  PlaneView plane;
  Storage storage = Storage::Exact;
};

/// The colours as R, G, B, and a plane as channels of the names in docs/output.md: "Z", "P.X", "face.id".
ExrLayers color_layers(const Image& image, ExrLayers::Storage storage);
ExrLayers plane_layers(const Image& image, Plane plane);

/// OpenEXR: scan lines, ZIP compression, linear light with the primaries of sRGB. Every plane has the same size; no
/// name is there twice.
std::vector<std::uint8_t> encode_exr(std::span<const ExrLayers> layers, int threads = 0);

/// Writes the whole file or nothing: under a temporary name beside `path`, then renamed. Throws Error, naming the file
/// and the reason (disk full included).
void write_file(const std::filesystem::path& path, std::span<const std::uint8_t> bytes);

}  // namespace facemap
