#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>

#include "scene/file_mapping.h"
#include "scene/gltf_file.h"

namespace facemap {

/// A part of a buffer: glTF's bufferView.
struct GltfBytes {
  std::string_view bytes;
  std::uint64_t stride = 0;  ///< between elements; 0: they follow each other
};

/// The bytes that a glTF file names: its own (GLB), those in data URIs, and those of files beside it, each read once
/// when it is asked for.
class GltfBuffers {
 public:
  explicit GltfBuffers(const GltfFile& file) : file_(file), total_(file.size) {}

  /// bufferViews[index]; `named_by` is whose index it is. Valid as long as this object. Throws LoadError.
  GltfBytes view(std::uint32_t index, const GltfValue& named_by);

  /// Of the file and of all files that were read for it so far.
  std::uint64_t total_bytes() const noexcept { return total_; }

 private:
  struct Buffer {
    std::string decoded;                ///< from a data URI
    std::unique_ptr<FileMapping> file;  ///< from a file
    std::string_view bytes;
  };

  std::string_view buffer(std::uint32_t index, const GltfValue& named_by);
  void fill(Buffer& buffer, std::uint32_t index, const GltfValue& value);
  void read_file(Buffer& buffer, const GltfValue& uri);

  const GltfFile& file_;
  std::map<std::uint32_t, Buffer> buffers_;
  std::uint64_t total_;
};

}  // namespace facemap
