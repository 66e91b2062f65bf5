#include "picture/shadow_rest.h"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>

#include "map/face_planes.h"
#include "math/dvector.h"

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

DVector place_of(const AskedPoints& points, std::uint32_t point) {
  return points.origin + points.step * DVector(points.x[point], points.y[point], points.z[point]);
}

// Of each coordinate of place_of, the roundings there included; of an offset from the light too, as long as those are
// bounded by its own size (verdict_on).
double error_of(const AskedPoints& points, std::uint32_t point) {
  const DVector p = place_of(points, point), size = glm::max(glm::abs(points.origin), glm::abs(p));
  return 2 * points.error + 0x1p-48 * std::max({size.x, size.y, size.z});
}

// Of the way from the light to a point.
Box box_of_way(const Vector& light, const AskedPoints& points, std::uint32_t point) {
  Box box{light, light};
  box.add(place_of(points, point));
  box.grow(error_of(points, point));
  return box;
}

double size_of(const DVector& a) { return std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z); }

// A plane through the light, or the plane of the face: its normal, turned inwards or away from the light, and by how
// much the normal and the doubles' dot product with an offset D are off, over |D|_1.
struct Plane {
  DVector normal;
  double error;
};

struct NearFace {
  std::uint32_t face;
  int side;
  Box box;
  Plane edges[3];
  Plane plane;
  double offset, offset_error;  // of the plane: a point is beyond it where normal . D > offset
};

// Roundings of doubles are bounded as in simd/shadow_planes.cpp: 2^-46 of products of lengths holds for each plane, and
// for its dot product with D.
constexpr double kRounding = 0x1p-45;

NearFace near_face(std::uint32_t face, int side, const Triangle& corners, const Box& box, const Vector& light) {
  const DVector A = DVector(corners[0]) - DVector(light), B = DVector(corners[1]) - DVector(corners[0]),
                C = DVector(corners[2]) - DVector(corners[0]);
  const DVector normal = cross(B, C), ab = cross(A, B), ca = cross(C, A);
  const double s = side, normal_error = kRounding * size_of(B) * size_of(C);
  const double error = kRounding * size_of(A) * (size_of(B) + size_of(C)) + normal_error;
  return {face,
          side,
          box,
          {{s * ab, error}, {s * ((normal - ab) - ca), error}, {s * ca, error}},
          {s * normal, normal_error},
          s * dot(A, normal),
          normal_error * size_of(A)};
}

// 1: the face surely blocks the point at D, within `error` in each coordinate; -1: it surely does not; 0: open.
int verdict_on(const NearFace& face, const DVector& D, double error) {
  const double size = size_of(D);
  bool is_sure = true;
  const auto is_no = [&](const Plane& plane, double offset, double offset_error) {
    const double value = dot(plane.normal, D) - offset;
    const double bound = plane.error * size + size_of(plane.normal) * (error + kRounding * size) + offset_error +
                         kRounding * std::fabs(offset);
    is_sure = is_sure && value > bound;
    return value < -bound;
  };
  if (is_no(face.plane, face.offset, face.offset_error)) return -1;
  for (const Plane& edge : face.edges) {
    if (is_no(edge, 0, 0)) return -1;
  }
  return is_sure ? 1 : 0;
}

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

  std::vector<NearFace> faces;
  for (const std::uint32_t face : scene.kept_faces()) {
    const Triangle corners = triangle_of(scene, face);
    const Box box = box_of(corners);
    if (!box.meets(all)) continue;
    const int side = facemap::side(corners, light, counters);
    if (side != 0) faces.push_back(near_face(face, side, corners, box, light));
  }
  std::uint64_t decided = 0;
  for (const std::uint32_t point : asked) {
    const Box way = box_of_way(light, points, point);
    const DVector D = place_of(points, point) - DVector(light);
    const double error = error_of(points, point);
    const auto blocks = [&](const NearFace& f) {
      if (f.face == points.faces[point] || !f.box.meets(way)) return false;
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
