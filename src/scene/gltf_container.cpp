#include "scene/gltf_container.h"

#include <facemap/error.h>

#include <cstdint>

namespace facemap {

namespace {

using Cause = LoadError::Cause;

constexpr std::string_view kMagic = "glTF";
constexpr std::size_t kHeaderSize = 12, kChunkHeaderSize = 8;
constexpr std::uint32_t kJsonChunk = 0x4e4f534a, kBinaryChunk = 0x004e4942;  ///< "JSON", "BIN\0"

/// Little endian; the bytes must be there.
std::uint32_t read_u32(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 4; i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return value;
}

[[noreturn]] void fail(Cause cause, const std::string& name, const std::string& reason) {
  throw LoadError(cause, name, 0, reason);
}

struct Chunk {
  std::uint32_t type;
  std::string_view bytes;
};

/// Takes the chunk that begins at `at`, and moves behind it.
Chunk take_chunk(std::string_view bytes, std::size_t& at, const std::string& name) {
  const std::size_t left = bytes.size() - at;
  if (left < kChunkHeaderSize) fail(Cause::TruncatedStatement, name, "the file ends within a chunk's header");
  const std::uint32_t size = read_u32(bytes, at), type = read_u32(bytes, at + 4);
  if (size > left - kChunkHeaderSize) {
    fail(Cause::TruncatedStatement, name,
         "a chunk of " + std::to_string(size) + " bytes, of which " + std::to_string(left - kChunkHeaderSize) +
             " are there");
  }
  at += kChunkHeaderSize + size;
  return {type, bytes.substr(at - size, size)};
}

/// Chunks of other types may follow, and are for programs that know them.
GltfContainer open_glb(std::string_view bytes, const std::string& name) {
  if (bytes.size() < kHeaderSize) fail(Cause::TruncatedStatement, name, "the file ends within its header");
  const std::uint32_t version = read_u32(bytes, 4), size = read_u32(bytes, 8);
  if (version != 2) {
    fail(Cause::Unsupported, name, "GLB of version " + std::to_string(version) + "; version 2 is read");
  }
  if (size > bytes.size() || size < kHeaderSize) {
    fail(Cause::TruncatedStatement, name,
         "the header says " + std::to_string(size) + " bytes, " + std::to_string(bytes.size()) + " are there");
  }
  bytes = bytes.substr(0, size);
  std::size_t at = kHeaderSize;
  const Chunk json = take_chunk(bytes, at, name);
  if (json.type != kJsonChunk) fail(Cause::BadSyntax, name, "the first chunk is not JSON");
  GltfContainer container{json.bytes, std::nullopt};
  if (at < bytes.size()) {
    const Chunk binary = take_chunk(bytes, at, name);
    if (binary.type == kBinaryChunk) container.binary = binary.bytes;
  }
  return container;
}

}  // namespace

GltfContainer GltfContainer::open(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with(kMagic)) return open_glb(bytes, name);
  if (bytes.starts_with("\xFE\xFF") || bytes.starts_with("\xFF\xFE")) {
    fail(Cause::BadEncoding, name, "UTF-16 text; glTF is UTF-8");
  }
  return {bytes, std::nullopt};
}

}  // namespace facemap
