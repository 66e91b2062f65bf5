#include <algorithm>
#include <span>

#include "map/face_planes.h"
#include "map/map_faces.h"
#include "map/ray_tests.h"
#include "math/dvector.h"
#include "math/exact_sign.h"
#include "visibility/ray_map.h"

namespace facemap {
namespace {

// A face that is met, with its parameter along the ray.
struct Entry {
  std::uint32_t face;
  int side;
  Triangle corners;
  Tracked t;
};

// The order of Viewpoint::all_hits, along a ray from O.
struct Order {
  Vector O, d;

  bool operator()(const Entry& a, const Entry& b) const {
    int sign = (a.t - b.t).sign();
    if (sign != 1 && sign != -1) sign = compare_depth(a.corners, a.side, b.corners, b.side, O, d);
    if (sign != 0) return sign < 0;
    return a.side != b.side ? a.side < b.side : a.face < b.face;
  }
};

}  // namespace

void RayMap::meet_all(const Texel& texel, const Vector& direction, std::vector<Meeting>& meetings) const {
  std::vector<Entry> entries;
  const auto add = [&](std::uint32_t id) {
    const Triangle corners = triangle_of(scene(), id);
    const int side = planes().side(id);
    entries.push_back({id, side, corners, ray_parameter({position(), direction, corners, side})});
  };
  const RayTests tests{scene(), planes(), position(), direction};
  const auto meet = [&](std::span<const std::uint32_t> ids, const auto& is_there) {
    tests.for_each_met(
        ids, [](std::uint32_t) { return false; },
        [&](std::uint32_t id, const Covering&) {
          if (is_there(id)) add(id);
        });
  };
  meet(faces_at(texel.x, texel.y), [](std::uint32_t) { return true; });
  meet(cut_outs_at(texel.x, texel.y),
       [&](std::uint32_t id) { return cut_outs().is_there(id, DVector(position()), DVector(direction)); });
  std::sort(entries.begin(), entries.end(), Order{position(), direction});
  const double size = length(DVector(direction));
  for (const Entry& entry : entries) {
    const double t = sharp_ray_parameter({position(), direction, entry.corners, entry.side}, entry.t);
    meetings.push_back({static_cast<FaceId>(entry.face), static_cast<float>(t * size)});
  }
}

}  // namespace facemap
