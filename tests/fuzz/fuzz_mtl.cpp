// Any bytes are an MTL file: what cannot be read is a warning.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "scene/mtl.h"
#include "scene/obj_materials.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace facemap;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  ObjWarnings warnings("fuzz.mtl");
  std::vector<Material> materials;
  ImageTable images({}, false);
  parse_mtl(text, {}, images, warnings, materials);
  for (const Material& material : materials) {
    if (!std::isfinite(material.diffuse.x) || !std::isfinite(material.opacity)) std::abort();
    for (const TextureUse& use : {material.diffuse_map, material.bump_map}) {
      if (use.is_used() && use.image >= images.images().size()) std::abort();
      if (!std::isfinite(use.scale.x) || !std::isfinite(use.strength)) std::abort();
    }
  }
  for (const std::string& name : split_library_names(text.substr(0, text.find('\n')))) {
    if (name.empty()) std::abort();
  }
  return 0;
}
