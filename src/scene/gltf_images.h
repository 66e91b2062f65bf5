#pragma once

#include <cstdint>
#include <map>

#include "scene/gltf_buffers.h"

namespace facemap {

/// Textures of a glTF file as the library's: each image once, those that nothing uses not at all.
class GltfImages {
 public:
  /// Images are appended to `images`.
  GltfImages(const GltfFile& file, GltfBuffers& buffers, std::vector<TextureImage>& images)
      : file_(file), buffers_(buffers), images_(images) {}

  /// The texture that a material's "...Texture" object names; not used, with a warning, if its image is not there.
  TextureUse texture(const GltfValue& info);

  /// The set of texture coordinates that such an object asks for.
  static std::uint32_t coordinate_set(const GltfValue& info);

 private:
  std::uint32_t image(std::uint32_t index, const GltfValue& named_by);
  bool read_image(const GltfValue& value, TextureImage& image);
  bool find_file(const GltfValue& uri, TextureImage& image);
  bool keep_bytes(const GltfValue& value, std::string_view bytes, TextureImage& image);

  const GltfFile& file_;
  GltfBuffers& buffers_;
  std::vector<TextureImage>& images_;
  std::map<std::uint32_t, std::uint32_t> places_;  ///< of an image in images_; kNoIndex: cannot be read
  std::uint64_t kept_bytes_ = 0;
};

}  // namespace facemap
