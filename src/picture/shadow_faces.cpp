#include "picture/shadow_faces.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "map/face_planes.h"
#include "picture/bytes_of.h"
#include "picture/face_texels.h"
#include "scene/reserve_pages.h"

namespace facemap {
namespace {

using simd::kShadowFaces;
using simd::ShadowPlanes;

constexpr std::size_t kGroup = ShadowPlanes::kFaces;

// Open pairs are kept until there are this many: by then most of their points are blocked for certain. Of given points
// more are open, those on their own faces: the later they are asked, the fewer.
constexpr std::size_t kMostUndecided = std::size_t{1} << 16, kMostUndecidedGiven = std::size_t{1} << 18;

// Pairs that are decided together: while they are, their points' other pairs are not left out.
constexpr std::size_t kGivenPairs = 1024;

// No w is greater: for faces of which nothing is known, and less than what a block has that is blocked altogether.
constexpr float kNoBound = 0x1p126f;

// Rows of a face that is to be passed over: the first is after the last.
constexpr std::int32_t kNoRows = 1;

struct Range {
  float lower = std::numeric_limits<float>::infinity();
  float upper = -std::numeric_limits<float>::infinity();

  void add(float x) {
    lower = std::min(lower, x);
    upper = std::max(upper, x);
  }
};

// One coordinate of a face that crosses the plane Z = 0 through the light. An edge from a corner in front to one behind
// leaves the raster's plane towards plus or minus infinity: for corners at u and u', Z > 0 > Z', it meets Z = 0 at an X
// of the sign of u - u'.
Range range_across(const Range& front, const Range& behind) {
  Range range = front;
  const float largest = std::max(
      {std::fabs(front.lower), std::fabs(front.upper), std::fabs(behind.lower), std::fabs(behind.upper), 1.0f});
  const float margin = simd::kShadowMargin * largest;
  if (front.upper + margin >= behind.lower) range.upper = std::numeric_limits<float>::infinity();
  if (front.lower - margin <= behind.upper) range.lower = -std::numeric_limits<float>::infinity();
  return range;
}

// First and last texel of a range, first | last << 16, as the kernels do it; the range must meet the raster.
std::int32_t texels_of(const Range& range, int count) {
  return texel_of(range.lower - simd::kShadowMargin, count) | texel_of(range.upper + simd::kShadowMargin, count) << 16;
}

bool meets_raster(const Range& range) {
  return range.lower <= 1 + simd::kShadowMargin && range.upper >= -1 - simd::kShadowMargin;
}

template <class T>
void move_to_front(T* array, std::size_t from, std::size_t end) {
  std::copy(array + from, array + end, array);
}

}  // namespace

void ShadowFaces::run(const ShadowRun& run, ShadowPoints& points, Counters& counters) {
  const Mesh& mesh = run.scene.mesh();
  const std::size_t vertices = mesh.positions.size();
  if (places_.size() < 3 * (vertices + 16)) {
    reserve_pages(places_, 3 * (vertices + 16));
    places_.resize(3 * (vertices + 16));
  }
  const bool has_odd_faces = run.scene.kept_faces().size() != mesh.face_count();
  simd::project_vertices(run.frame, &mesh.positions[0].x, vertices, places_.data());

  queue_.count = 0;
  undecided_.clear();
  const std::size_t most_undecided = run.given != nullptr ? kMostUndecidedGiven : kMostUndecided;
  if (run.given != nullptr) reserve_pages(undecided_, std::min(most_undecided, points.count()));
  const std::size_t count = run.some != nullptr ? run.some->size() : mesh.face_count();
  for (std::size_t first = 0; first < count; first += kShadowFaces) {
    const std::size_t waiting = queue_.count;
    sift(run, points, first, std::min(first + kShadowFaces, count));
    queue_across(run, points.raster());
    if (has_odd_faces) drop_odd_faces(run.scene, waiting);
    test_first(run, points, queue_.count / kGroup * kGroup, counters);
    if (undecided_.size() > most_undecided) resolve(run, points);
  }
  test_first(run, points, queue_.count, counters);
  resolve(run, points);
}

// Of faces first..last-1, or of those places in run.some.
void ShadowFaces::sift(const ShadowRun& run, const ShadowPoints& points, std::size_t first, std::size_t last) {
  const Mesh& mesh = run.scene.mesh();
  simd::FacesToSift faces{mesh.triangles[0].data(), places_.data(),     run.skip_entries, first, last,
                          points.raster(),          &points.farthest(), points.occupied()};
  if (run.some == nullptr) return simd::sift_faces(faces, queue_);
  const std::uint32_t* numbers = run.some->data() + first;
  corners_of_some_.resize(3 * kShadowFaces);
  for (std::size_t i = 0; i < last - first; ++i) {
    const Corners& corners = mesh.triangles[numbers[i]];
    std::copy(corners.begin(), corners.end(), corners_of_some_.begin() + static_cast<std::ptrdiff_t>(3 * i));
  }
  faces.corners = corners_of_some_.data();
  faces.skip_entries = nullptr;  // settle_sides has those that matter all the same
  faces.first = 0;
  faces.last = last - first;
  const std::size_t waiting = queue_.count;
  simd::sift_faces(faces, queue_);
  for (std::size_t i = waiting; i < queue_.count; ++i) queue_.face[i] = numbers[queue_.face[i]];
  for (std::size_t i = 0; i < queue_.across_count; ++i) queue_.across[i] = numbers[queue_.across[i]];
}

void ShadowFaces::drop_odd_faces(const Scene& scene, std::size_t first) {
  std::size_t kept = first;
  for (std::size_t i = first; i < queue_.count; ++i) {
    if (!scene.is_kept(queue_.face[i])) continue;
    queue_.face[kept] = queue_.face[i];
    queue_.columns[kept] = queue_.columns[i];
    queue_.rows[kept] = queue_.rows[i];
    queue_.nearest[kept] = queue_.nearest[i];
    ++kept;
  }
  queue_.count = kept;
}

void ShadowFaces::queue_across(const ShadowRun& run, const simd::ShadowRaster& raster) {
  for (std::size_t i = 0; i < queue_.across_count; ++i) {
    Range u[2], v[2];  // in front, behind
    bool is_placed = true;
    for (const std::uint32_t vertex : run.scene.mesh().triangles[queue_.across[i]]) {
      const float* place = &places_[3 * static_cast<std::size_t>(vertex)];
      is_placed = is_placed && !std::isnan(place[2]);
      u[place[2] < 0].add(place[0]);
      v[place[2] < 0].add(place[1]);
    }
    const Range across = is_placed ? range_across(u[0], u[1]) : Range{-1, 1};
    const Range along = is_placed ? range_across(v[0], v[1]) : Range{-1, 1};
    if (!meets_raster(across) || !meets_raster(along)) continue;
    const std::size_t n = queue_.count++;
    queue_.face[n] = queue_.across[i];
    queue_.columns[n] = texels_of(across, raster.columns);
    queue_.rows[n] = texels_of(along, raster.rows);
    queue_.nearest[n] = kNoBound;
  }
}

// Tests the first `count` faces of the queue and takes them out of it.
void ShadowFaces::test_first(const ShadowRun& run, ShadowPoints& points, std::size_t count, Counters& counters) {
  if (count == 0) return;
  const std::size_t groups = (count + kGroup - 1) / kGroup, whole = groups * kGroup;
  for (std::size_t i = count; i < whole; ++i) {
    queue_.face[i] = queue_.face[0];
    queue_.columns[i] = 0;
    queue_.rows[i] = kNoRows;
    queue_.nearest[i] = 0;
  }
  corners_.resize(std::max(corners_.size(), groups));
  planes_.resize(std::max(planes_.size(), groups));
  sides_.resize(std::max(sides_.size(), whole));

  const Mesh& mesh = run.scene.mesh();
  for (std::size_t i = 0; i < whole; ++i) {
    float(*corners)[3][kGroup] = corners_[i / kGroup].of;
    const Corners& vertices = mesh.triangles[queue_.face[i]];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vector& p = mesh.positions[vertices[k]];
      corners[k][0][i % kGroup] = p.x;
      corners[k][1][i % kGroup] = p.y;
      corners[k][2][i % kGroup] = p.z;
    }
  }
  simd::set_up_planes(run.frame, corners_.data(), groups, run.slack, planes_.data(), sides_.data());
  settle_sides(run, count, counters);

  simd::SortedPoints sorted = points.sorted();
  for (std::size_t g = 0; g < groups; ++g) {
    const std::size_t i = g * kGroup;
    const simd::ShadowBatch batch{&planes_[g],     queue_.face + i,    queue_.columns + i,
                                  queue_.rows + i, queue_.nearest + i, &sides_[i]};
    counters.by_float += simd::test_points(batch, sorted, jobs_, undecided_);
  }
  move_to_front(queue_.face, count, queue_.count);
  move_to_front(queue_.columns, count, queue_.count);
  move_to_front(queue_.rows, count, queue_.count);
  move_to_front(queue_.nearest, count, queue_.count);
  queue_.count -= count;
}

// Sides that doubles leave open are asked of exact arithmetic; faces seen edge-on and entry faces are passed over.
void ShadowFaces::settle_sides(const ShadowRun& run, std::size_t count, Counters& counters) {
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t face = queue_.face[i];
    if (sides_[i] == 0) {
      sides_[i] = static_cast<std::int8_t>(side(triangle_of(run.scene, face), run.light, &counters));
      if (sides_[i] < 0) {
        ShadowPlanes& planes = planes_[i / kGroup];
        for (auto& edge : planes.edges) {
          for (auto& coefficient : edge) coefficient[i % kGroup] = -coefficient[i % kGroup];
        }
      }
    }
    const bool is_skipped = sides_[i] < 0 && run.skip_entries != nullptr && run.skip_entries[face] != 0;
    if (sides_[i] == 0 || is_skipped) queue_.rows[i] = kNoRows;
  }
}

void ShadowFaces::resolve(const ShadowRun& run, ShadowPoints& points) {
  if (run.given != nullptr) decide_given(run, points);
  for (const simd::UndecidedPair& pair : undecided_) {
    if (points.is_blocked(pair.place)) continue;
    if (run.blocks_exactly(points.point_at(pair.place), pair.face, pair.side)) points.set_blocked(pair.place);
  }
  undecided_.clear();
}

// Doubles decide almost all pairs of given points, many at a time; the others stay.
void ShadowFaces::decide_given(const ShadowRun& run, ShadowPoints& points) {
  const Mesh& mesh = run.scene.mesh();
  const simd::GivenPoints given{
      run.given, mesh.triangles[0].data(), &mesh.positions[0].x, {run.light.x, run.light.y, run.light.z}};
  std::size_t kept = 0;
  for (std::size_t first = 0; first < undecided_.size(); first += kGivenPairs) {
    const std::size_t last = std::min(first + kGivenPairs, undecided_.size()), begin = kept;
    given_.clear();
    for (std::size_t i = first; i < last; ++i) {
      const simd::UndecidedPair pair = undecided_[i];
      if (points.is_blocked(pair.place)) continue;
      given_.push_back({points.point_at(pair.place), pair.face});
      undecided_[kept++] = pair;
    }
    verdicts_.resize(given_.size());
    simd::decide_pairs(given, given_.data(), given_.size(), verdicts_.data());
    kept = begin;
    for (std::size_t k = 0; k < given_.size(); ++k) {
      if (verdicts_[k] == 1) points.set_blocked(undecided_[begin + k].place);
      if (verdicts_[k] == 2) undecided_[kept++] = undecided_[begin + k];
    }
  }
  undecided_.resize(kept);
}

std::size_t ShadowFaces::memory_bytes() const noexcept {
  return sizeof(*this) + bytes_of(places_) + bytes_of(corners_) + bytes_of(planes_) + bytes_of(sides_) +
         bytes_of(corners_of_some_) + bytes_of(jobs_) + bytes_of(undecided_) + bytes_of(given_) + bytes_of(verdicts_);
}

}  // namespace facemap
