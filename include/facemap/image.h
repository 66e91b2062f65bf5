#pragma once

#include <facemap/color.h>
#include <facemap/display.h>
#include <facemap/face.h>
#include <facemap/plane.h>
#include <facemap/vector.h>

#include <cstdint>
#include <filesystem>
#include <vector>

namespace facemap {

/// A picture and the planes (AOVs) behind it. Wang 2022, sec. 4.3: the Image class. Row by row from the top;
/// pixel (x, y) is element y * width + x of each array. A plane that was not asked for is empty; the others hold the
/// ray through the pixel's centre, and what is said after the semicolon where it sees no face. World units and axes.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<Color> pixels;            ///< linear RGB
  std::vector<FaceId> ids;              ///< face that is seen; kNoFace
  std::vector<float> depths;            ///< distance from the ray's origin to the point that is seen; infinity
  std::vector<float> zs;                ///< the share of it along the sight, below 0 behind the camera; infinity
  std::vector<Vector> positions;        ///< of the point; NaN
  std::vector<Vector> normals;          ///< of shading: unit, smooth and with reliefs if the picture is; 0
  std::vector<Vector> face_normals;     ///< of the face's plane: unit, on the side that is seen; 0
  std::vector<Color> albedos;           ///< diffuse or base colour with its texture, linear RGB; 0
  std::vector<glm::vec2> uvs;           ///< texture coordinates as the model has them; NaN, also where it has none
  std::vector<std::int32_t> objects;    ///< into Scene::objects(); -1, also where it has none
  std::vector<std::int32_t> materials;  ///< into Scene::materials(); -1, also where it has none
  std::vector<std::uint8_t> lights;   ///< ceil(light_count/8) bytes, least significant bit first, 1 = it gets there; 0
  std::vector<std::int32_t> shadows;  ///< lights that do not get there: hidden, turned away, beyond cone or range; -1
  int light_count = 0;

  int light_bytes() const { return (light_count + 7) / 8; }
};

/// The picture's colours after exposure and curve, still linear; no planes. The same bits on every machine. `threads`
/// work on it (0: as many as the process may run at once). Throws Error if the exposure is out of range.
Image displayed(const Image& image, const DisplayTransform& display, int threads = 0);

/// Writes 8-bit RGB PNG. The file appears whole or not at all: it is written under a temporary name
/// beside `path` and renamed. `threads` work on it (0: as many as the process may run at once); the bytes do not depend
/// on them. Throws Error, naming the file and the reason (disk full included).
void write_png(const Image& image, const std::filesystem::path& path, int threads = 0,
               const DisplayTransform& display = {});

/// The bytes of that file, for a pipe or a web server. Throws Error if the image is empty.
std::vector<std::uint8_t> encode_png(const Image& image, int threads = 0, const DisplayTransform& display = {});

/// Writes one plane as a NumPy .npy file (version 1.0), the same way: [H,W], or [H,W,C] for planes of several numbers a
/// pixel; float32, int32, or uint8 (Lights). Throws Error, too, if the image has no such plane.
void write_npy(const Image& image, Plane plane, const std::filesystem::path& path);

/// Reads a PNG of 8-bit RGB as 24-bit values, row by row. Throws Error. For comparing pictures.
struct Picture24 {
  int width = 0;
  int height = 0;
  std::vector<std::uint32_t> pixels;  ///< 0xRRGGBB
};
Picture24 read_png(const std::filesystem::path& path);

}  // namespace facemap
