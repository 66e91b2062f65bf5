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

void WaitingBoxes::append(const BoxQueues& queues) {
  for (int q = 0; q < BoxQueues::kQueues; ++q) {
    const simd::BoxQueue& queue = queues[q];
    List& list = lists_[q];
    list.faces.insert(list.faces.end(), queue.faces, queue.faces + queue.size);
    list.x0.insert(list.x0.end(), queue.x0, queue.x0 + queue.size);
    list.x1.insert(list.x1.end(), queue.x1, queue.x1 + queue.size);
    list.y0.insert(list.y0.end(), queue.y0, queue.y0 + queue.size);
    list.y1.insert(list.y1.end(), queue.y1, queue.y1 + queue.size);
  }
}

void WaitingBoxes::take(int queue, int first_row, int last_row, simd::BoxQueue& out) const {
  const List& list = lists_[queue];
  std::size_t n = 0;
  for (std::size_t i = 0; i < list.faces.size(); ++i) {
    out.faces[n] = list.faces[i];
    out.x0[n] = list.x0[i];
    out.x1[n] = list.x1[i];
    out.y0[n] = list.y0[i];
    out.y1[n] = list.y1[i];
    n += list.y0[i] <= last_row && list.y1[i] >= first_row;
  }
  out.size = n;
}

}  // namespace facemap
