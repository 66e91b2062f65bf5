#include "picture/nearest_queues.h"

#include <algorithm>

namespace facemap {

BoxQueues::BoxQueues(std::size_t capacity) {
  const std::size_t room = capacity + simd::kVertexRoom;
  words_ = std::make_unique_for_overwrite<std::uint32_t[]>(room * 5 * kQueues);
  std::uint32_t* next = words_.get();
  const auto numbers = [&] {
    auto* start = reinterpret_cast<std::int32_t*>(next);
    next += room;
    return start;
  };
  for (simd::BoxQueue& queue : queues_) {
    queue.faces = next;
    next += room;
    queue.x0 = numbers();
    queue.x1 = numbers();
    queue.y0 = numbers();
    queue.y1 = numbers();
    queue.size = 0;
  }
}

simd::BoxQueue* BoxQueues::fresh() {
  for (simd::BoxQueue& queue : queues_) queue.size = 0;
  return queues_;
}

void BoxQueues::drop_odd_faces(const Scene& scene) {
  if (scene.kept_faces().size() == scene.face_count()) return;
  for (simd::BoxQueue& queue : queues_) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < queue.size; ++i) {
      queue.faces[n] = queue.faces[i];
      queue.x0[n] = queue.x0[i];
      queue.x1[n] = queue.x1[i];
      queue.y0[n] = queue.y0[i];
      queue.y1[n] = queue.y1[i];
      n += scene.is_kept(queue.faces[i]);
    }
    queue.size = n;
  }
}

void DealtBoxes::deal(const BoxQueues& queues, const std::vector<std::uint16_t>& band_of_row, std::size_t bands) {
  bands_ = bands;
  begins_.assign(BoxQueues::kQueues * bands + 1, 0);
  const auto for_each_band = [&](int q, std::size_t i, const auto& visit) {
    const auto row = [](std::int32_t y) { return static_cast<std::size_t>(y); };
    const simd::BoxQueue& queue = queues[q];
    const std::size_t last = band_of_row[row(queue.y1[i])];
    for (std::size_t band = band_of_row[row(queue.y0[i])]; band <= last; ++band) visit(q * bands + band);
  };
  for (int q = 0; q < BoxQueues::kQueues; ++q) {
    for (std::size_t i = 0; i < queues[q].size; ++i) {
      for_each_band(q, i, [&](std::size_t place) { ++begins_[place + 1]; });
    }
  }
  for (std::size_t i = 1; i < begins_.size(); ++i) begins_[i] += begins_[i - 1];

  room_ = begins_.back() + simd::kVertexRoom;
  words_ = std::make_unique_for_overwrite<std::uint32_t[]>(5 * room_);
  std::vector<std::uint32_t> next(begins_.begin(), begins_.end() - 1);
  for (int q = 0; q < BoxQueues::kQueues; ++q) {
    const simd::BoxQueue& queue = queues[q];
    for (std::size_t i = 0; i < queue.size; ++i) {
      for_each_band(q, i, [&](std::size_t place) {
        std::uint32_t* at = words_.get() + next[place]++;
        at[0] = queue.faces[i];
        at[room_] = static_cast<std::uint32_t>(queue.x0[i]);
        at[2 * room_] = static_cast<std::uint32_t>(queue.x1[i]);
        at[3 * room_] = static_cast<std::uint32_t>(queue.y0[i]);
        at[4 * room_] = static_cast<std::uint32_t>(queue.y1[i]);
      });
    }
  }
}

simd::BoxQueue DealtBoxes::of(int queue, std::size_t band) const {
  const std::size_t place = static_cast<std::size_t>(queue) * bands_ + band;
  std::uint32_t* const faces = words_.get() + begins_[place];
  const auto numbers = [&](std::size_t row) { return reinterpret_cast<std::int32_t*>(faces + row * room_); };
  return {faces, numbers(1), numbers(2), numbers(3), numbers(4), begins_[place + 1] - begins_[place]};
}

}  // namespace facemap
