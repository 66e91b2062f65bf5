#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "material/texture.h"
#include "parallel/executor.h"

namespace facemap {

/// Of a material's diffuse map: whether its alpha is what cuts its surface.
inline Encoding encoding_of_diffuse(const Material& material) {
  const bool is_own = !material.opacity_map.is_used() || material.opacity_map.image == material.diffuse_map.image;
  return material.alpha != Material::Alpha::Opaque && is_own ? Encoding::CutOuts : Encoding::Srgb;
}

/// The images that a scene's materials use, decoded, each once for each encoding that it is used in.
class TextureSet {
 public:
  /// Images of more than `max_pixels` are refused. What cannot be read is a warning.
  TextureSet(const Scene& scene, std::uint64_t max_pixels, const Executor& executor);

  /// Null if the use has no image, or one that cannot be read.
  const Texture* find(const TextureUse& use, Encoding encoding) const;

  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  using Key = std::pair<std::uint32_t, Encoding>;

  std::map<Key, std::unique_ptr<const Texture>> textures_;
  std::vector<std::string> warnings_;
};

}  // namespace facemap
