#pragma once

#include <vector>

#include "visibility/fitted_view.h"

namespace facemap {

/// A view that keeps the faces behind others too.
class WholeView : public FittedView {
 public:
  WholeView(const Scene& scene, const Vector& position, const MapFaces& faces);

  struct Meeting {
    FaceId face;
    float distance;  ///< world units
  };

  /// Adds all faces that the ray along `direction` meets, in the order of Viewpoint::all_hits.
  void meet_all(const Vector& direction, std::vector<Meeting>& meetings) const;

 private:
  class Order;
};

}  // namespace facemap
