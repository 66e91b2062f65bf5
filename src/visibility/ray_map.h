#pragma once

#include <facemap/camera.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace facemap {

/// A face that a ray meets.
struct Meeting {
  FaceId face;
  float distance;  ///< world units
};

/// A camera's map for questions about rays: one of those that RayLists is made of.
class RayMap : public Camera {
 public:
  RayMap(const MapFaces& faces, const SpaceVector& frame, const Projection& projection,
         std::shared_ptr<const FacePlanesTable> planes, bool keep_all);

  static constexpr std::uint32_t kSkipNone = 0xffffffffu;

  /// As Camera::nearest, for a direction of the texel.
  Camera::Hit nearest_in(const Texel& texel, const Vector& direction) const;

  /// What Viewpoint::blocked_by answers for one point in a direction of the texel, or nothing if the lists do not tell:
  /// the faces behind one that fills a texel are not kept, and `skip` may be that face.
  std::optional<FaceId> first_blocker(const Texel& texel, const Vector& point, std::uint32_t skip) const;

  /// Adds all faces that the ray along `direction`, which is of the texel, meets, in the order of Viewpoint::all_hits.
  /// The map must keep all.
  void meet_all(const Texel& texel, const Vector& direction, std::vector<Meeting>& meetings) const;
};

}  // namespace facemap
