#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "picture/bytes_of.h"
#include "picture/texel_lists.h"
#include "scene/face_neighbours.h"
#include "simd/bounded_points.h"
#include "simd/shadow_frame.h"

namespace facemap {

/// A light's map that is kept: which distances are surely lit or surely dark in each direction, whatever the picture.
/// Most points of a picture are decided by it at once; the others are held against faces.
class LightBounds {
 public:
  /// `skip_entries`, one byte a face, or null: as for clear_blocked; then `lit` holds for points that may leave those
  /// faces out. Nothing if the light does not have all of the scene well in front of it, or if large
  /// faces lie over each other so often that it would take long. `wants_lists`: of faces by texel; else, and where they
  /// do not fit, one list serves all texels.
  ///
  /// Time: about 450 ns a face. Memory: 4 bytes a texel, which are at most 1 MB or, with more faces, as many as faces;
  /// with lists at most 26 bytes a face; 9 bytes a texel and 70 a face while it is made.
  static std::optional<LightBounds> find(const Scene& scene, const Vector& light, const std::uint8_t* skip_entries,
                                         const std::vector<FaceNeighbours>& neighbours, bool wants_lists = true);

  const simd::ShadowFrame& frame() const noexcept { return frame_; }
  simd::TexelBounds texels() const noexcept { return {texels_.data(), size_, w_least_, w_scale_}; }
  /// The only faces that may stand between the light and a point that is not decided, ascending; or null: any may. Of
  /// the points that have no place on the raster it holds for those off it and for those nearer than all faces.
  const std::vector<std::uint32_t>* faces() const noexcept { return has_faces_ ? &faces_ : nullptr; }
  /// For each texel the faces that may stand between the light and a point there that is not decided; or null.
  const TexelLists* lists() const noexcept { return lists_.any() ? &lists_ : nullptr; }
  /// Whether each point that is left without a place because its Z is below `nearest` is nearer than all faces.
  bool all_faces_are_beyond(float nearest) const noexcept { return double{nearest} * w_greatest_ <= 1; }
  std::size_t memory_bytes() const noexcept {
    return sizeof(*this) + bytes_of(texels_) + bytes_of(faces_) + lists_.memory_bytes();
  }

 private:
  class Finder;
  LightBounds() = default;

  simd::ShadowFrame frame_{};
  int size_ = 0;
  float w_least_ = 0, w_scale_ = 0;
  float w_greatest_ = 0;  // no point of a face has a greater w, nor would a point there be computed to have one
  std::vector<std::uint32_t> texels_;
  bool has_faces_ = false;
  std::vector<std::uint32_t> faces_;
  TexelLists lists_;
};

}  // namespace facemap
