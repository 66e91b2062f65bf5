#pragma once

#include <facemap/vector.h>

#include <cstdint>
#include <vector>

#include "parallel/executor.h"

namespace facemap {

class Scene;

/// The connected parts of a scene whose surface is closed for certain: directed edges cancel, vertices welded by
/// position, over the kept faces and those without area. For such a part, seen from outside, only the faces turned away
/// from a light need be asked (docs/algorithm.md).
///
/// Parts may be nested, intersect each other or themselves, or be inside out. Two closed parts that touch in a vertex
/// are one here, which is as good: all the proof asks of a part is that its edges cancel, as they do in a union.
class ClosedParts {
 public:
  /// Time: about 20 ns a face. Memory: at its peak 10 bytes a vertex and the edges whose opposite is far away in the
  /// file, 8 bytes each; kept are 24 bytes a closed part, and 8 for each run of faces of one part.
  ClosedParts(const Scene& scene, const Executor& executor);

  bool any() const noexcept { return !boxes_.empty(); }
  std::size_t closed_count() const noexcept { return boxes_.size(); }

  /// One byte a closed part: 1 if the point, which must be finite, is off the part and its winding number about the
  /// point is 0, for certain. Time: constant for a part in whose box the point is not, some ns a face for the others.
  std::vector<std::uint8_t> outside(const Scene& scene, const Vector& point) const;

  /// One byte a face: 1 where the face belongs to a closed part about which both points have winding number 0
  /// for certain. Empty if there is none.
  std::vector<std::uint8_t> skippable_entries(const Scene& scene, const Vector& camera, const Vector& light) const;

  /// The same for several lights: `outside_camera` is outside(scene, camera).
  std::vector<std::uint8_t> skippable_entries(const Scene& scene, const std::vector<std::uint8_t>& outside_camera,
                                              const Vector& light) const;

 private:
  /// Axis-parallel.
  struct Box {
    Vector lower, upper;
  };
  /// Faces side by side of the same part, up to the next run. kOpen stands for all parts that are not closed.
  struct Run {
    std::uint32_t first_face, part;
  };
  static constexpr std::uint32_t kOpen = 0xffffffffu;

  void make_boxes(const Scene& scene, const std::vector<std::uint32_t>& part_of_vertex, std::size_t part_count);
  void ask_ray(const Scene& scene, const Vector& point, int direction, std::vector<std::uint8_t>& answers) const;

  template <class Visit>
  void for_each_run(std::size_t face_count, const Visit& visit) const;

  std::vector<Box> boxes_;  ///< one a part, holding all vertices of its faces
  std::vector<Run> runs_;
};

}  // namespace facemap
