#pragma once

#include <facemap/scene.h>
#include <facemap/vector.h>

#include <cstdint>
#include <span>
#include <vector>

#include "parallel/executor.h"

namespace facemap {

/// Axis-parallel boxes about faces, about four of these, and so on: which faces a ray may meet. Float32 boxes are
/// exact, and the test of a ray errs to one side only.
class FaceTree {
 public:
  /// `faces`: ids of those that count.
  FaceTree(const Scene& scene, std::vector<std::uint32_t> faces, const Executor& executor);

  /// Sets `found` to faces that the ray from `origin` along `direction` may meet before the parameter `end`, all of
  /// those that it does meet among them. Gives the number of boxes looked at.
  std::size_t find(const Vector& origin, const Vector& direction, double end, std::vector<std::uint32_t>& found) const;

  std::size_t memory_bytes() const noexcept;

 private:
  struct Box {
    Vector lower, upper;
  };
  class Ray;

  void sort(const Scene& scene, const Executor& executor);
  void make_boxes(const Scene& scene, const Executor& executor);

  std::vector<std::uint32_t> faces_;      // along a curve through space
  std::vector<std::vector<Box>> levels_;  // of faces, then each of four below; the last has at most four
};

}  // namespace facemap
