#include <facemap/atomic_file.h>
#include <facemap/error.h>

#include <bit>
#include <cstring>
#include <string>

#include "image/plane.h"

namespace facemap {
namespace {

static_assert(std::endian::native == std::endian::little, "the arrays below are written as they lie in memory");

const char* type_name(std::span<const float>) { return "<f4"; }
const char* type_name(std::span<const std::int32_t>) { return "<i4"; }
const char* type_name(std::span<const std::uint16_t>) { return "<u2"; }
const char* type_name(std::span<const std::uint8_t>) { return "|u1"; }

/// Magic, version, length of the header (little-endian), the header, padded with spaces and ended by a newline so that
/// the data begins at a multiple of 64 bytes.
std::string npy_header(const PlaneView& plane, NpyShape shape) {
  check_plane("NPY", plane);
  constexpr std::size_t kPrefix = 10, kAlignment = 64;
  const std::string type = std::visit([](const auto& values) { return type_name(values); }, plane.values);
  std::string dictionary = "{'descr': '" + type + "', 'fortran_order': False, 'shape': (";
  dictionary += std::to_string(plane.height) + ", " + std::to_string(plane.width);
  if (plane.channels > 1 || shape == NpyShape::AlwaysThree) dictionary += ", " + std::to_string(plane.channels);
  dictionary += "), }";
  dictionary.append((kAlignment - (kPrefix + dictionary.size() + 1) % kAlignment) % kAlignment, ' ');
  dictionary += '\n';
  std::string header = "\x93NUMPY";
  header += {'\x01', '\x00', static_cast<char>(dictionary.size() & 255), static_cast<char>(dictionary.size() >> 8)};
  return header + dictionary;
}

std::span<const std::byte> bytes_of(const PlaneView& plane) {
  return std::visit([](const auto& values) { return std::as_bytes(values); }, plane.values);
}

}  // namespace

std::vector<std::uint8_t> encode_npy(const PlaneView& plane, NpyShape shape) {
  const std::string header = npy_header(plane, shape);
  const std::span<const std::byte> values = bytes_of(plane);
  std::vector<std::uint8_t> bytes(header.size() + values.size());
  std::memcpy(bytes.data(), header.data(), header.size());
  std::memcpy(bytes.data() + header.size(), values.data(), values.size());
  return bytes;
}

void write_npy(const Image& image, Plane plane, const std::filesystem::path& path) {
  PlaneView view;
  try {
    view = plane_view(image, plane);
  } catch (const Error& error) {
    throw Error(path.string() + ": " + error.what());
  }
  const std::string header = npy_header(view, NpyShape::ByChannels);
  const std::span<const std::byte> values = bytes_of(view);  // written as they are, without a copy
  AtomicFile file(path);
  file.write(header.data(), header.size());
  file.write(values.data(), values.size());
  file.commit();
}

}  // namespace facemap
