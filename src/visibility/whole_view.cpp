#include "visibility/whole_view.h"

#include <algorithm>
#include <optional>
#include <span>

#include "map/face_planes.h"
#include "map/map_faces.h"
#include "map/ray_tests.h"
#include "math/dvector.h"
#include "math/exact_sign.h"

namespace facemap {

WholeView::WholeView(const Scene&, const Vector& position, const MapFaces& faces) : FittedView(faces, position, true) {}

// A face that is met, with its parameter along the ray.
class WholeView::Order {
 public:
  Order(const WholeView& view, const Vector& direction) : view_(view), direction_(direction) {}

  struct Entry {
    std::uint32_t face;
    Triangle corners;
    Tracked t;
  };

  Entry entry(std::uint32_t face) const {
    const Triangle corners = triangle_of(view_.scene(), face);
    return {face, corners, ray_parameter({view_.position(), direction_, corners, view_.planes().side(face)})};
  }

  bool operator()(const Entry& a, const Entry& b) const {
    const int side_a = view_.planes().side(a.face), side_b = view_.planes().side(b.face);
    int sign = (a.t - b.t).sign();
    if (sign != 1 && sign != -1) {
      sign = compare_depth(a.corners, side_a, b.corners, side_b, view_.position(), direction_);
    }
    if (sign != 0) return sign < 0;
    return side_a != side_b ? side_a < side_b : a.face < b.face;
  }

 private:
  const WholeView& view_;
  Vector direction_;
};

void WholeView::meet_all(const Vector& direction, std::vector<Meeting>& meetings) const {
  const std::optional<Texel> texel = texel_of(DVector(direction));
  if (!texel) return;
  const Order order(*this, direction);
  std::vector<Order::Entry> entries;
  const RayTests tests{scene(), planes(), position(), direction};
  const auto meet = [&](std::span<const std::uint32_t> ids, const auto& is_there) {
    tests.for_each_met(
        ids, [](std::uint32_t) { return false; },
        [&](std::uint32_t id, const Covering&) {
          if (is_there(id)) entries.push_back(order.entry(id));
        });
  };
  meet(faces_at(texel->x, texel->y), [](std::uint32_t) { return true; });
  meet(cut_outs_at(texel->x, texel->y),
       [&](std::uint32_t id) { return cut_outs().is_there(id, DVector(position()), DVector(direction)); });
  std::sort(entries.begin(), entries.end(), order);
  const double size = length(DVector(direction));
  for (const Order::Entry& entry : entries) {
    const TruePoint point{position(), direction, entry.corners, planes().side(entry.face)};
    meetings.push_back(
        {static_cast<FaceId>(entry.face), static_cast<float>(sharp_ray_parameter(point, entry.t) * size)});
  }
}

}  // namespace facemap
