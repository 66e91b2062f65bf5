#pragma once

#include <facemap/viewpoint.h>

#include <cstddef>
#include <memory>

#include "map/map_faces.h"
#include "parallel/executor.h"
#include "visibility/made_once.h"
#include "visibility/ray_lists.h"
#include "visibility/visible_face_search.h"
#include "visibility/visible_points.h"

namespace facemap {

/// What a viewpoint keeps from question to question. Its parts are made when they are first needed.
struct Viewpoint::Kept {
  Kept(const Scene& scene, const Vector& origin, const Options& options);

  /// Not to be called by the executor's tasks: they might wait for a thread that waits for them.
  const RayLists& near_lists();   ///< without what is behind a face that fills a texel
  const RayLists& whole_lists();  ///< of all faces
  const VisibleFaceSearch& face_search();

  const Scene& scene;
  Vector origin;
  Options options;
  Executor executor;
  MapFaces faces;
  VisiblePoints visible_points;
  MadeOnce<VisibleFaceSearch> seen_faces;
  MadeOnce<std::shared_ptr<const FacePlanesTable>> planes;
  MadeOnce<RayLists> near, whole;

 private:
  std::unique_ptr<RayLists> make_lists(bool keep_all);
};

/// Throws Error unless there are as many answers as questions.
void check_size(std::size_t answers, std::size_t questions);

}  // namespace facemap
