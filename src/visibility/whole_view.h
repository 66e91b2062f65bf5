#pragma once

#include <facemap/camera.h>

#include <vector>

namespace facemap {

/// A camera's map of all directions that keeps the faces behind others too.
class WholeView : public Camera {
 public:
  WholeView(const Scene& scene, const Vector& position, const MapFaces& faces);

  struct Meeting {
    FaceId face;
    float distance;  ///< world units
  };

  /// Writes all faces that the ray along `direction` meets, in the order of Viewpoint::all_hits.
  void meet_all(const Vector& direction, std::vector<Meeting>& meetings) const;

 private:
  class Order;
};

}  // namespace facemap
