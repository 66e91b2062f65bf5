#pragma once

#include <facemap/camera.h>

#include <cstdint>
#include <optional>

namespace facemap {

/// A camera's map of all directions in which there are faces: where it has no texel, there are none.
class FittedView : public Camera {
 public:
  FittedView(const MapFaces& faces, const Vector& origin, bool keep_all);

  static constexpr std::uint32_t kSkipNone = 0xffffffffu;

  /// What Viewpoint::blocked_by answers for one point, or nothing if the lists do not tell: the faces behind one that
  /// fills a texel are not kept, and `skip` may be that face.
  std::optional<FaceId> first_blocker(const Vector& point, std::uint32_t skip) const;
};

}  // namespace facemap
