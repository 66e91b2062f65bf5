#include "file_format.h"

#include <facemap/image_file.h>

#include <algorithm>

#include "output.h"
#include "text_values.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

struct Picture {
  const Image& image;
  const FormatSettings& settings;
  PlaneSet layers;
  int threads;
};

Bytes png_of(const Picture& picture) {
  const DisplayTransform& display = picture.settings.display;
  if (picture.settings.bits != 16) return encode_png(picture.image, picture.threads, display);
  const std::vector<std::uint16_t> levels =
      display.keeps_light()
          ? levels_16(picture.image, display.transfer, picture.threads)
          : levels_16(displayed(picture.image, display, picture.threads), display.transfer, picture.threads);
  return encode_png_16({picture.image.width, picture.image.height, 3, std::span(levels)}, display.transfer,
                       picture.threads);
}

Bytes jpeg_of(const Picture& picture) {
  const DisplayTransform& display = picture.settings.display;
  const std::vector<std::uint8_t> levels =
      display.keeps_light() ? levels_8(picture.image) : levels_8(displayed(picture.image, display, picture.threads));
  return encode_jpeg({picture.image.width, picture.image.height, 3, std::span(levels)}, picture.settings.quality);
}

Bytes exr_of(const Picture& picture) {
  const auto storage = picture.settings.bits == 32 ? ExrLayers::Storage::Exact : ExrLayers::Storage::Half;
  std::vector<ExrLayers> layers = {color_layers(picture.image, storage)};
  for (const Plane plane : all_planes()) {
    if (picture.layers.has(plane)) layers.push_back(plane_layers(picture.image, plane));
  }
  return encode_exr(layers, picture.threads);
}

Bytes pfm_of(const Picture& picture) { return encode_pfm(color_plane(picture.image)); }

Bytes npy_of(const Picture& picture) { return encode_npy(color_plane(picture.image)); }

/// One a format, in the order of FileFormat.
struct Row {
  std::string name;
  std::vector<std::string> extensions;
  std::vector<int> bits;  ///< that a channel may have; the first is the default
  Bytes (*encode)(const Picture&);
};

const std::vector<Row>& rows() {
  static const std::vector<Row> table = {
      {"png", {".png"}, {8, 16}, png_of},  {"jpeg", {".jpg", ".jpeg"}, {8}, jpeg_of},
      {"exr", {".exr"}, {16, 32}, exr_of}, {"pfm", {".pfm"}, {32}, pfm_of},
      {"npy", {".npy"}, {32}, npy_of},
  };
  return table;
}

const Row& row_of(FileFormat format) { return rows()[static_cast<std::size_t>(format)]; }

std::string known_extensions() {
  std::string list;
  for (const Row& row : rows()) {
    for (const std::string& extension : row.extensions) list += (list.empty() ? "" : ", ") + extension;
  }
  return list;
}

std::string lower_case(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return text;
}

bool fits_pfm(Plane plane) {
  return PlaneSet{Plane::Depth, Plane::Z, Plane::Position, Plane::Normal, Plane::FaceNormal, Plane::Albedo}.has(plane);
}

}  // namespace

const std::vector<std::string>& format_names() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Row& row : rows()) list.push_back(row.name);
    return list;
  }();
  return names;
}

FileFormat format_of(const fs::path& file) {
  const std::string extension = lower_case(file.extension().string());
  if (is_standard_output(file) || extension.empty()) return FileFormat::Png;
  for (std::size_t i = 0; i < rows().size(); ++i) {
    const std::vector<std::string>& known = rows()[i].extensions;
    if (std::find(known.begin(), known.end(), extension) != known.end()) return static_cast<FileFormat>(i);
  }
  throw UsageError(file.string() + ": no format is known by the name " + extension + "; known are " +
                   known_extensions());
}

FileFormat picture_format(const fs::path& file, const FormatSettings& settings) {
  const FileFormat format = settings.format ? *settings.format : format_of(file);
  const std::vector<int>& known = row_of(format).bits;
  if (format == FileFormat::Jpeg && settings.display.transfer != Transfer::Srgb) {
    throw UsageError("--transfer linear: a JPEG file cannot say so; write .png");
  }
  if (settings.bits == 0 || std::find(known.begin(), known.end(), settings.bits) != known.end()) return format;
  std::string list;
  for (const int bits : known) list += (list.empty() ? "" : " or ") + std::to_string(bits);
  throw UsageError("--bits " + std::to_string(settings.bits) + ": a channel of " + row_of(format).name + " has " +
                   list + " bits");
}

FileFormat plane_format(const fs::path& file, Plane plane) {
  const FileFormat format = format_of(file);
  if (format == FileFormat::Pfm && !fits_pfm(plane)) {
    throw UsageError(file.string() + ": PFM holds one or three floats a pixel, which " + name_of(plane) +
                     " is not; write .npy or .exr");
  }
  return format;
}

Bytes encode_picture(const Image& image, FileFormat format, const FormatSettings& settings, PlaneSet layers,
                     int threads) {
  return row_of(format).encode({image, settings, layers, threads});
}

Bytes encode_plane(const Image& image, Plane plane, FileFormat format, int quality, int threads) {
  switch (format) {
    case FileFormat::Exr: {
      const ExrLayers layers[] = {plane_layers(image, plane)};
      return encode_exr(layers, threads);
    }
    case FileFormat::Pfm:
      return encode_pfm(plane_view(image, plane));
    case FileFormat::Npy:
      return encode_npy(plane_view(image, plane));
    case FileFormat::Png:
    case FileFormat::Jpeg:
      break;
  }
  FormatSettings settings;
  settings.quality = quality;
  return encode_picture(plane_picture(image, plane), format, settings, {}, threads);
}

}  // namespace facemap::program
