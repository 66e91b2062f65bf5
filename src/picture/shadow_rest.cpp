#include "picture/shadow_rest.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "map/face_planes.h"
#include "math/dvector.h"
#include "picture/near_face.h"

namespace facemap {
namespace {

struct Box {
  DVector lower, upper;

  void add(const DVector& p) {
    lower = glm::min(lower, p);
    upper = glm::max(upper, p);
  }
  void grow(double by) {
    lower -= by;
    upper += by;
  }
  bool meets(const Box& other) const {
    return lower.x <= other.upper.x && other.lower.x <= upper.x && lower.y <= other.upper.y &&
           other.lower.y <= upper.y && lower.z <= other.upper.z && other.lower.z <= upper.z;
  }
};

Box box_of(const Triangle& face) {
  Box box{face[0], face[0]};
  box.add(face[1]);
  box.add(face[2]);
  return box;
}

// Of the way from the light to a point.
Box box_of_way(const Vector& light, const AskedPoints& points, std::uint32_t point) {
  Box box{light, light};
  box.add(place_of(points, point));
  box.grow(error_of(points, point));
  return box;
}

struct BoxedFace {
  NearFace face;
  Box box;
};

}  // namespace

std::vector<std::uint32_t> find_blocked_singly(const Scene& scene, const Vector& light, const AskedPoints& points,
                                               const std::vector<std::uint32_t>& asked,
                                               const BlocksExactly& blocks_exactly, Counters* counters) {
  std::vector<std::uint32_t> blocked;
  if (asked.empty()) return blocked;
  Box all{light, light};
  for (const std::uint32_t point : asked) {
    const Box way = box_of_way(light, points, point);
    all.add(way.lower);
    all.add(way.upper);
  }

  std::vector<BoxedFace> faces;
  for (const std::uint32_t face : scene.kept_faces()) {
    const Triangle corners = triangle_of(scene, face);
    const Box box = box_of(corners);
    if (!box.meets(all)) continue;
    const int side = facemap::side(corners, light, counters);
    if (side != 0) faces.push_back({near_face(face, side, corners, light), box});
  }
  std::uint64_t decided = 0;
  for (const std::uint32_t point : asked) {
    const Box way = box_of_way(light, points, point);
    const DVector D = place_of(points, point) - DVector(light);
    const double error = error_of(points, point);
    const auto blocks = [&](const BoxedFace& boxed) {
      const NearFace& f = boxed.face;
      if (f.face == points.faces[point] || !boxed.box.meets(way)) return false;
      const int verdict = verdict_on(f, D, error);
      decided += verdict != 0;
      return verdict != 0 ? verdict > 0 : blocks_exactly(point, f.face, f.side);
    };
    if (std::any_of(faces.begin(), faces.end(), blocks)) blocked.push_back(point);
  }
  if (counters != nullptr) counters->by_double += decided;
  return blocked;
}

}  // namespace facemap
