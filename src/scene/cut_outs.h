#pragma once

#include <facemap/scene.h>
#include <facemap/surface_point.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "scene/alpha_mask.h"
#include "scene/surface_coordinates.h"

namespace facemap {

/// A scene in which some materials have holes. Its faces are told apart once and for all: solid ones, those that are
/// cut out by a texture, and those of which nothing is there. What relies on faces without holes takes solid(); only
/// what tests each crossing by is_there() may take cut().
///
/// Solid faces and those cut out are no duplicates of each other: of solid faces with the same three positions the
/// lowest id stays, of cut out ones all do, as their holes differ.
class CutOuts {
 public:
  /// Null if all faces of the scene are solid.
  static std::shared_ptr<const CutOuts> find(const Scene& scene, std::uint64_t max_texture_pixels, int threads);

  const Scene& solid() const noexcept { return solid_; }
  const Scene& cut() const noexcept { return cut_; }
  const Scene& shown() const noexcept { return shown_; }  ///< both

  /// Whether some face is cut out by a texture.
  bool any() const noexcept { return !cut_.kept_faces().empty(); }

  /// Whether a face that is cut out is there where the line from p along d meets it, in double, by the one sequence of
  /// operations that shading takes too.
  bool is_there(std::uint32_t face, const DVector& p, const DVector& d) const;

  /// Images that could not be read, and materials of which nothing is there.
  const std::vector<std::string>& warnings() const noexcept { return warnings_; }

 private:
  struct Sorted;

  CutOuts(const Scene& scene, std::vector<AlphaMask>&& masks, Sorted&& sorted, std::vector<std::string>&& warnings);

  std::vector<AlphaMask> masks_;  // one a material
  Scene solid_, cut_, shown_;
  std::vector<std::string> warnings_;
};

/// A point that is seen, in double: where lines to lights begin, whoever asks.
inline DVector seen_point(const SurfacePoint& p) {
  return point_on_plane(corners_of(p.vertices[0], p.vertices[1], p.vertices[2]), DVector(p.origin),
                        DVector(p.direction));
}

}  // namespace facemap
