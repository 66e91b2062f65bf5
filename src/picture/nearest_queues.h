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

/// The same, dealt to the bands of rows that they reach, and as long as needed.
class DealtBoxes {
 public:
  /// `band_of_row` has a band's number, below `bands`, for each row of the grid; ascending.
  void deal(const BoxQueues& queues, const std::vector<std::uint16_t>& band_of_row, std::size_t bands);

  /// Those of a queue that reach a band, in the order of the queue. As FaceBoxes they may be read past their end.
  simd::BoxQueue of(int queue, std::size_t band) const;

 private:
  std::unique_ptr<std::uint32_t[]> words_;  // faces, x0, x1, y0, y1
  std::size_t room_ = 0;                    // of each
  std::size_t bands_ = 0;
  std::vector<std::uint32_t> begins_;  // by queue and band
};

}  // namespace facemap
