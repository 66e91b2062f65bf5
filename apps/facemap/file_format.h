#pragma once

#include <facemap/image.h>
#include <facemap/plane.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace facemap::program {

/// How pictures and planes are written.
enum class FileFormat { Png, Jpeg, Exr, Pfm, Npy };

/// What a user may say about a picture's file besides its name.
struct FormatSettings {
  std::optional<FileFormat> format;  ///< instead of what the name says
  int bits = 0;                      ///< a channel; 0: the format's own
  int quality = 90;                  ///< of JPEG, 1 to 100
  DisplayTransform display;          ///< for formats of levels: PNG and JPEG
};

/// "png", "jpeg" and so on, in the order of FileFormat.
const std::vector<std::string>& format_names();

/// The format that a file's name says; PNG for standard output and names without an extension. Throws UsageError that
/// names all formats if it is none of them.
FileFormat format_of(const std::filesystem::path& file);

/// The format of the picture. Throws UsageError, as format_of or if it has no channels of so many bits.
FileFormat picture_format(const std::filesystem::path& file, const FormatSettings& settings);

/// The format of a plane's file. Throws UsageError if the format cannot hold the plane.
FileFormat plane_format(const std::filesystem::path& file, Plane plane);

/// The bytes of a file. `layers`: planes that an EXR file holds besides the picture.
std::vector<std::uint8_t> encode_picture(const Image& image, FileFormat format, const FormatSettings& settings,
                                         PlaneSet layers, int threads);
std::vector<std::uint8_t> encode_plane(const Image& image, Plane plane, FileFormat format, int quality, int threads);

}  // namespace facemap::program
