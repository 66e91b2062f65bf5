#pragma once

#include <cstddef>
#include <optional>

#include "map/map_faces.h"
#include "parallel/executor.h"
#include "picture/light_bounds.h"
#include "visibility/loss.h"
#include "visibility/made_once.h"
#include "visibility/point_lists.h"
#include "visibility/point_question.h"
#include "visibility/points_by_faces.h"
#include "visibility/told_progress.h"

namespace facemap {

/// Which points are visible from one origin, whatever they are and however many at a time. Many points ask all faces
/// (points_by_faces.h), few ask lists that are kept (point_lists.h); bounds that are kept (picture/light_bounds.h)
/// decide a part of many points beforehand. What is kept is made once questions have lost as much by not having it as
/// making it takes. Several threads may ask together.
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
  const LightBounds* bounds();
  const PointLists& lists();
  const PointLists& cut_out_lists();

  void ask_solid(const PointQuestion& question, ToldProgress& told);
  void ask_listed(const PointQuestion& question, ToldProgress& told);
  void ask_lists(const PointLists& lists, const PointQuestion& question, ToldProgress& told);
  template <class Body>
  void for_listed_pieces(const PointQuestion& question, ToldProgress& told, const Body& body);

  const MapFaces& faces_;
  const Vector& origin_;
  const Executor& executor_;
  MadeOnce<std::optional<LightBounds>> bounds_;  // nothing if the origin does not have all faces in front of it
  MadeOnce<PointLists> lists_, cut_out_lists_;
  Loss by_faces_, without_bounds_;
  FacesSpares spares_;
};

}  // namespace facemap
