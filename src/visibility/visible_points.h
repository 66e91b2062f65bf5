#pragma once

#include <cstddef>
#include <mutex>
#include <optional>

#include "map/map_faces.h"
#include "parallel/executor.h"
#include "picture/light_bounds.h"
#include "visibility/made_once.h"
#include "visibility/point_lists.h"
#include "visibility/points_by_bounds.h"
#include "visibility/points_by_faces.h"

namespace facemap {

/// Which points are visible from one origin, whatever they are and however many at a time. Points may ask all faces, or
/// what is kept: bounds with lists (picture/light_bounds.h) if the origin has the scene in front of it, else lists
/// (point_lists.h). These are made once questions have lost as much by not having them as making them takes.
/// Several threads may ask together.
class VisiblePoints {
 public:
  VisiblePoints(const MapFaces& faces, const Vector& origin, const Executor& executor)
      : faces_(faces), origin_(origin), executor_(executor) {}

  /// Makes what is kept.
  void prepare();

  /// As Viewpoint::visible.
  void ask(const Viewpoint::Targets& targets, std::span<std::uint8_t> visible, const Viewpoint::Progress& progress);

  std::size_t memory_bytes() const;

 private:
  const std::optional<LightBounds>& bounds();
  const PointLists& lists();
  const PointLists& cut_out_lists();

  void ask_solid(const PointQuestion& question, ToldProgress& told);
  void ask_lists(const PointLists& lists, const PointQuestion& question, ToldProgress& told);
  bool is_worth_making(double loss, double making);

  const MapFaces& faces_;
  const Vector& origin_;
  const Executor& executor_;
  MadeOnce<std::optional<LightBounds>> bounds_;
  MadeOnce<PointLists> lists_, cut_out_lists_;
  std::mutex losing_;
  double lost_ = 0;  // by questions so far, nanoseconds
  Spares<ShadowScratch> shadow_spares_;
  Spares<BoundsScratch> bounds_spares_;
};

}  // namespace facemap
