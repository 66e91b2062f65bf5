#pragma once

#include <facemap/color.h>
#include <facemap/face.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace facemap {

/// A picture and the planes (AOVs) behind it. Wang 2022, sec. 4.3: the Image class. Row by row from the top;
/// pixel (x, y) is element y * width + x of each array. A plane that was not asked for is empty.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Color> pixels;         ///< linear RGB
  std::vector<FaceId> ids;           ///< face seen by the ray through the pixel's centre; kNoFace: none
  std::vector<float> depths;         ///< distance along that ray, world units; infinity: none
  std::vector<std::uint8_t> lights;  ///< ceil(light_count/8) bytes a pixel, least significant bit first, 1 = lit
  int light_count = 0;

  int light_bytes() const { return (light_count + 7) / 8; }
};

/// Writes 8-bit RGB PNG (sRGB). The file appears whole or not at all: it is written under a temporary name
/// beside `path` and renamed. `threads` work on it (0: as many as the process may run at once); the bytes do not depend
/// on them. Throws Error, naming the file and the reason (disk full included).
void write_png(const Image& image, const std::filesystem::path& path, int threads = 0);

/// The bytes of that file, for a pipe or a web server. Throws Error if the image is empty.
std::vector<std::uint8_t> encode_png(const Image& image, int threads = 0);

/// Write one plane as a NumPy .npy file (version 1.0), the same way: int32 [H,W], float32 [H,W], uint8 [H,W,B].
void write_ids_npy(const Image& image, const std::filesystem::path& path);
void write_depths_npy(const Image& image, const std::filesystem::path& path);
void write_lights_npy(const Image& image, const std::filesystem::path& path);

/// Reads a PNG of 8-bit RGB as 24-bit values, row by row. Throws Error. For comparing pictures.
struct Picture24 {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> pixels;  ///< 0xRRGGBB
};
Picture24 read_png(const std::filesystem::path& path);

}  // namespace facemap
