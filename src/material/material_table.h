#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <string>
#include <vector>

#include "material/brdf.h"
#include "material/footprint.h"
#include "material/relief.h"
#include "material/texture_set.h"
#include "scene/texture_place.h"

namespace facemap {

/// What shading needs of one face: kept while points of the same face follow one another.
struct FaceFrame {
  std::uint32_t face = kNoIndex;
  FaceCorners corners{};
  CornerCoordinates coordinates;
  CoordinateGradient gradient;
};

/// A point that a ray sees.
struct SeenSurface {
  std::uint32_t face = 0;
  DVector weights{0};      ///< of the corners
  DVector normal{0};       ///< for shading: unit, on the camera's side
  bool is_behind = false;  ///< the camera sees the face from behind
  DVector camera{0};
  RayBundle rays;
};

/// What the surface is there.
struct SurfaceLook {
  Reflection reflection;
  DVector albedo{1};    ///< diffuse or base colour
  DVector normal{0};    ///< tilted by the material's relief
  DVector emission{0};  ///< of an unlit surface: its colour
  bool is_unlit = false;
};

/// A scene's materials and textures, ready for shading. Const members may be called by several threads together.
class MaterialTable {
 public:
  /// Whether a scene has anything to show but white.
  static bool is_needed(const Scene& scene);

  /// The scene must outlive it. Images of more than `max_pixels` are refused. What cannot be read is a warning, and its
  /// material goes on with its constants.
  MaterialTable(const Scene& scene, std::uint64_t max_pixels, const Executor& executor);

  const std::vector<std::string>& warnings() const { return textures_.warnings(); }

  /// Whether look() needs the rays to the right and down for a face. A face without texture coordinates has no
  /// textures.
  bool has_textures(std::uint32_t face) const;

  /// `frame`: working memory of the caller, from call to call.
  SurfaceLook look(const SeenSurface& seen, FaceFrame& frame) const;

 private:
  /// A texture as one material uses it.
  struct Map {
    const TextureUse* use;
    const Texture* texture;  // null: none
    TexturePlace place;

    Map(const TextureSet& textures, const TextureUse& from, Encoding encoding)
        : use(&from), texture(textures.find(from, encoding)), place(from) {}
  };

  struct Entry {
    Entry(const TextureSet& textures, const Material& from);

    const Material* material;
    Map diffuse, specular, emission, shininess, metallic, roughness, normal, bump;
    bool has_textures;
  };

  /// Where on its textures a point is.
  struct Spot {
    bool is_known = false;  ///< else textures are left out
    TexturePoint uv{0};
    Footprint footprint;
  };

  const Entry* entry_of(std::uint32_t face) const;
  void set_up(FaceFrame& frame, std::uint32_t face) const;
  Spot spot_of(const SeenSurface& seen, const FaceFrame& frame) const;
  static TextureValue value(const Map& map, const Spot& spot, const TexturePoint& offset = TexturePoint(0));
  static DVector colour(const Map& map, const Spot& spot, const Vector& factor);
  static double number(const Map& map, const Spot& spot, float factor);
  static DVector relief(const Entry& entry, const Spot& spot, const SeenSurface& seen, const FaceFrame& frame);
  static Reflection reflection(const Entry& entry, const Spot& spot, const DVector& diffuse);

  const Scene& scene_;
  TextureSet textures_;
  std::vector<Entry> entries_;
};

}  // namespace facemap
