#include "scene/closed_parts.h"

#include <facemap/scene.h>

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <limits>

#include "scene/closed_edges.h"
#include "scene/closed_winding.h"
#include "scene/vertex_sets.h"
#include "scene/welded.h"

namespace facemap {

namespace {

constexpr std::size_t kLeastPiece = 1 << 15;  ///< faces worth a task of their own

/// The vertices that faces connect.
VertexSets connected_vertices(const Scene& scene, const Executor& executor) {
  VertexSets sets(scene.mesh().positions.size(), executor.threads() > 1);
  for_ranges(executor, scene.face_count(), kLeastPiece, [&](std::size_t first, std::size_t last, int) {
    for (std::size_t face = first; face != last; ++face) {
      const Corners c = welded_corners(scene.mesh().triangles[face], scene.welded());
      if (!has_edges(scene, face, c)) continue;
      sets.join(c[0], c[1]);
      sets.join(c[1], c[2]);
    }
  });
  sets.flatten(executor);
  return sets;
}

/// Answers to whether a point is outside a part, while they are sought.
enum Answer : std::uint8_t { kNo, kYes, kOpenQuestion };

bool is_finite(const Vector& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

ClosedParts::ClosedParts(const Scene& scene, const Executor& executor) {
  const VertexSets sets = connected_vertices(scene, executor);
  const ClosedSets found = find_closed_sets(scene, sets, executor);
  if (std::find(found.kinds.begin(), found.kinds.end(), SetKind::Closed) == found.kinds.end()) return;

  std::vector<std::uint32_t> part_of_vertex(sets.size());
  std::uint32_t part_count = 0;
  for (std::uint32_t vertex = 0; vertex < sets.size(); ++vertex) {
    const std::uint32_t root = sets.root_of(vertex);  // the least of its set, so its part is known
    if (root != vertex) {
      part_of_vertex[vertex] = part_of_vertex[root];
    } else {
      part_of_vertex[vertex] = found.kinds[vertex] == SetKind::Closed ? part_count++ : kOpen;
    }
  }
  make_boxes(scene, part_of_vertex, part_count);
  for (const FaceRun& run : found.runs) {
    const std::uint32_t part = part_of_vertex[run.root];
    if (runs_.empty() || runs_.back().part != part) runs_.push_back({run.first_face, part});
  }
  runs_.shrink_to_fit();
}

void ClosedParts::make_boxes(const Scene& scene, const std::vector<std::uint32_t>& part_of_vertex,
                             std::size_t part_count) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  boxes_.assign(part_count, {Vector(kInfinity), Vector(-kInfinity)});
  for (std::size_t vertex = 0; vertex < part_of_vertex.size(); ++vertex) {
    const std::uint32_t part = part_of_vertex[vertex];
    if (part == kOpen) continue;
    const Vector& position = scene.mesh().positions[vertex];
    Box& box = boxes_[part];
    box.lower = glm::min(box.lower, position);
    box.upper = glm::max(box.upper, position);
  }
}

/// Calls visit(part, first_face, end_face) for the runs of closed parts.
template <class Visit>
void ClosedParts::for_each_run(std::size_t face_count, const Visit& visit) const {
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    const std::size_t end = i + 1 < runs_.size() ? runs_[i + 1].first_face : face_count;
    if (runs_[i].part != kOpen) visit(runs_[i].part, runs_[i].first_face, end);
  }
}

std::vector<std::uint8_t> ClosedParts::outside(const Scene& scene, const Vector& point) const {
  if (!is_finite(point)) return std::vector<std::uint8_t>(boxes_.size(), kNo);
  std::vector<std::uint8_t> answers;
  answers.reserve(boxes_.size());
  for (const Box& box : boxes_) {
    // On the box's own faces the point may be on the part.
    const bool in_box =
        glm::all(glm::lessThanEqual(box.lower, point)) && glm::all(glm::lessThanEqual(point, box.upper));
    answers.push_back(in_box ? kOpenQuestion : kYes);
  }
  for (int direction = 0; direction < WindingRay::kDirections; ++direction) {
    if (std::find(answers.begin(), answers.end(), kOpenQuestion) == answers.end()) break;
    ask_ray(scene, point, direction, answers);
  }
  std::replace(answers.begin(), answers.end(), std::uint8_t{kOpenQuestion}, std::uint8_t{kNo});
  return answers;
}

/// Answers open questions by one ray; those of parts that it meets in an edge or a vertex stay open.
void ClosedParts::ask_ray(const Scene& scene, const Vector& point, int direction,
                          std::vector<std::uint8_t>& answers) const {
  struct Sum {
    std::int64_t crossings = 0;
    bool is_known = true;
  };
  const WindingRay ray(point, scene.centre(), direction);
  const Mesh& mesh = scene.mesh();
  std::vector<Sum> sums(boxes_.size());
  for_each_run(scene.face_count(), [&](std::uint32_t part, std::size_t first, std::size_t end) {
    if (answers[part] != kOpenQuestion) return;
    for (std::size_t face = first; face != end && sums[part].is_known; ++face) {
      if (!scene.is_kept(face)) continue;
      const std::optional<int> crossing =
          ray.crossing({mesh.vertex(face, 0), mesh.vertex(face, 1), mesh.vertex(face, 2)});
      sums[part].is_known = crossing.has_value();
      sums[part].crossings += crossing.value_or(0);
    }
  });
  for (std::size_t part = 0; part < answers.size(); ++part) {
    if (answers[part] == kOpenQuestion && sums[part].is_known) answers[part] = sums[part].crossings == 0 ? kYes : kNo;
  }
}

std::vector<std::uint8_t> ClosedParts::skippable_entries(const Scene& scene, const Vector& camera,
                                                         const Vector& light) const {
  return skippable_entries(scene, outside(scene, camera), light);
}

std::vector<std::uint8_t> ClosedParts::skippable_entries(const Scene& scene,
                                                         const std::vector<std::uint8_t>& outside_camera,
                                                         const Vector& light) const {
  std::vector<std::uint8_t> outside_both = outside(scene, light);
  for (std::size_t part = 0; part < outside_both.size(); ++part) outside_both[part] &= outside_camera[part];
  if (std::find(outside_both.begin(), outside_both.end(), kYes) == outside_both.end()) return {};
  std::vector<std::uint8_t> skippable(scene.face_count(), 0);
  for_each_run(scene.face_count(), [&](std::uint32_t part, std::size_t first, std::size_t end) {
    std::fill(skippable.begin() + static_cast<std::ptrdiff_t>(first),
              skippable.begin() + static_cast<std::ptrdiff_t>(end), outside_both[part]);
  });
  return skippable;
}

}  // namespace facemap
