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
