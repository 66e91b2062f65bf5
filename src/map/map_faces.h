#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <memory>
#include <utility>

#include "scene/cut_outs.h"

namespace facemap {

/// Which faces of a scene a map takes: all, or only those with holes, for whoever asks the others in another way.
struct MapFaces {
  const Scene& scene;
  std::shared_ptr<const CutOuts> cut_outs;  ///< null: all faces are solid
  bool is_cut_alone = false;                ///< then there are cut-outs

  const Scene& all() const {
    if (cut_outs == nullptr) return scene;
    return is_cut_alone ? cut_outs->cut() : cut_outs->shown();
  }
  const Scene& solid() const { return cut_outs == nullptr ? scene : cut_outs->solid(); }
  bool has_cut_outs() const { return cut_outs != nullptr && cut_outs->any(); }
};

/// As options say: of a scene whose materials count or not.
inline MapFaces map_faces(const Scene& scene, bool has_cut_outs, std::uint64_t max_texture_pixels) {
  return {scene, has_cut_outs ? scene.cut_outs(max_texture_pixels) : nullptr};
}

}  // namespace facemap
