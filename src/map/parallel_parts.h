#pragma once

#include <facemap/parallel_map.h>

#include <optional>
#include <span>

#include "map/parallel_faces.h"
#include "map/parallel_frame.h"
#include "map/texels.h"

namespace facemap {

/// What a ParallelMap is made of.
struct ParallelMap::Parts {
  Parts(const Scene& scene, const Vector& direction, const Options& options);
  Parts(const Parts&) = delete;  // `faces` refers to `frame`

  ParallelFrame frame;
  ParallelFaces faces;
  Texels texels;

  /// The faces that may meet the line through a place, front to back; all kept faces, in no order, if that is not
  /// known.
  struct Candidates {
    std::span<const std::uint32_t> ids;
    float cut;  ///< depth behind which candidates may be missing, infinity if none are
    bool is_list;
  };
  Candidates candidates(const Scene& scene, const ParallelFrame::Place& place) const;

  /// The place for the filter; none for one that is too far off.
  std::optional<ParallelFaces::Asked> asked(const Candidates& candidates, const ParallelFrame::Place& place) const;
};

}  // namespace facemap
