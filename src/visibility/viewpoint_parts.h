#pragma once

#include <facemap/viewpoint.h>

#include <cstddef>

#include "map/map_faces.h"
#include "parallel/executor.h"
#include "visibility/fitted_view.h"
#include "visibility/made_once.h"
#include "visibility/visible_face_search.h"
#include "visibility/visible_points.h"
#include "visibility/whole_view.h"

namespace facemap {

/// What a viewpoint keeps from question to question. Its parts are made when they are first needed.
struct Viewpoint::Kept {
  Kept(const Scene& scene, const Vector& origin, const Options& options);

  const FittedView& near_view();  ///< keeps what is nearest
  const WholeView& whole_view();
  const VisibleFaceSearch& face_search();

  const Scene& scene;
  Vector origin;
  Options options;
  Executor executor;
  MapFaces faces;
  MadeOnce<FittedView> near;
  MadeOnce<WholeView> whole;
  VisiblePoints visible_points;
  MadeOnce<VisibleFaceSearch> seen_faces;
};

/// Throws Error unless there are as many answers as questions.
void check_size(std::size_t answers, std::size_t questions);

}  // namespace facemap
