#include <facemap/error.h>
#include <facemap/image.h>

#include <bit>
#include <string>

#include "image/atomic_file.h"

namespace facemap {
namespace {

static_assert(std::endian::native == std::endian::little, "the arrays below are written as they lie in memory");

/// NumPy's .npy, version 1.0: magic, version, length of the header (little-endian), the header, padded with
/// spaces and ended by a newline so that the data begins at a multiple of 64 bytes.
std::string npy_header(const std::string& type, const std::string& shape) {
  constexpr std::size_t kPrefix = 10, kAlignment = 64;
  std::string dictionary = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (" + shape + "), }";
  dictionary.append((kAlignment - (kPrefix + dictionary.size() + 1) % kAlignment) % kAlignment, ' ');
  dictionary += '\n';
  std::string header = "\x93NUMPY";
  header += {'\x01', '\x00', static_cast<char>(dictionary.size() & 255), static_cast<char>(dictionary.size() >> 8)};
  return header + dictionary;
}

template <typename Value>
void write_plane(const std::filesystem::path& path, const std::string& type, const Image& image, int values_a_pixel,
                 const std::vector<Value>& plane, const char* name) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (plane.size() != pixels * static_cast<std::size_t>(values_a_pixel)) {
    throw Error(path.string() + ": the image has no plane of " + name);
  }
  std::string shape = std::to_string(image.height) + ", " + std::to_string(image.width);
  if (sizeof(Value) == 1) shape += ", " + std::to_string(values_a_pixel);
  const std::string header = npy_header(type, shape);
  AtomicFile file(path);
  file.write(header.data(), header.size());
  file.write(plane.data(), plane.size() * sizeof(Value));
  file.commit();
}

}  // namespace

void write_ids_npy(const Image& image, const std::filesystem::path& path) {
  write_plane(path, "<i4", image, 1, image.ids, "ids");
}

void write_depths_npy(const Image& image, const std::filesystem::path& path) {
  write_plane(path, "<f4", image, 1, image.depths, "depths");
}

void write_lights_npy(const Image& image, const std::filesystem::path& path) {
  write_plane(path, "|u1", image, image.light_bytes(), image.lights, "lights");
}

}  // namespace facemap
