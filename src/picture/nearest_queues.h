#pragma once

#include <facemap/scene.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "simd/nearest_boxes.h"
#include "simd/nearest_planes.h"

namespace facemap {

/// Faces and their boxes by queue, as simd::find_boxes makes them for up to `capacity` faces at a time.
class BoxQueues {
 public:
  static constexpr int kQueues = simd::kSmallQueues + 1;

  explicit BoxQueues(std::size_t capacity);

  /// Empties the queues and gives them to find_boxes.
  simd::BoxQueue* fresh();

  /// Leaves the faces that take part in maps.
  void drop_odd_faces(const Scene& scene);

  simd::BoxQueue& operator[](int queue) { return queues_[queue]; }
  const simd::BoxQueue& operator[](int queue) const { return queues_[queue]; }

 private:
  std::unique_ptr<std::uint32_t[]> words_;
  simd::BoxQueue queues_[kQueues];
};

/// The same, as long as needed and no longer: what waits for its band of rows.
class WaitingBoxes {
 public:
  void append(const BoxQueues& queues);

  /// Fills `out`, which has room for all, with the boxes of a queue that reach rows first_row..last_row.
  void take(int queue, int first_row, int last_row, simd::BoxQueue& out) const;

 private:
  struct List {
    std::vector<std::uint32_t> faces;
    std::vector<std::int32_t> x0, x1, y0, y1;
  };
  List lists_[BoxQueues::kQueues];
};

}  // namespace facemap
