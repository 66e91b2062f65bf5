#include "map/nearest_hit.h"

#include <cmath>

#include "map/face_planes.h"

namespace facemap {

NearestHit::NearestHit(const Scene& scene, const Vector& origin, const Vector& direction, Counters* counters)
    : scene_(scene),
      O_(origin),
      d_(direction),
      length_(std::sqrt(double(d_.x) * d_.x + double(d_.y) * d_.y + double(d_.z) * d_.z)),
      counters_(counters) {}

void NearestHit::meet(std::uint32_t id, int side, bool strictly_inside) {
  const Triangle face = triangle_of(scene_, id);
  const TruePoint point{O_, d_, face, side};
  const Tracked t = ray_parameter(point);
  const int order = hit_ ? compare(t, face, side) : -1;
  if (order == 0) {
    hit_.tied = true;
    // Wins: the face turned towards the camera, then the lower id.
    const bool wins = side != hit_.side ? side < hit_.side : static_cast<FaceId>(id) < hit_.face;
    if (!wins) return;
  } else if (order > 0) {
    return;
  } else {
    hit_.tied = false;
  }
  hit_.face = static_cast<FaceId>(id);
  hit_.side = side;
  hit_.strictly_inside = strictly_inside;
  t_ = t;
  face_ = face;
}

double NearestHit::reach() const { return hit_ ? (t_.value + t_.error) * length_ * (1 + 0x1p-40) : HUGE_VAL; }

Camera::Hit NearestHit::with_depth() const {
  Camera::Hit hit = hit_;
  if (hit) hit.depth = static_cast<float>(sharp_ray_parameter({O_, d_, face_, hit.side}, t_) * length_);
  return hit;
}

// Sign of the new face's distance minus the best one's.
int NearestHit::compare(const Tracked& t, const Triangle& face, int side) const {
  const int sign = (t - t_).sign();
  if (sign == 1 || sign == -1) return sign;
  return compare_depth(face, side, face_, hit_.side, O_, d_, counters_);
}

}  // namespace facemap
