#include "picture/moved_points.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numeric>

#include "math/dvector.h"

namespace facemap {
namespace {

constexpr std::size_t kFewestPoints = 16384;  // a task
constexpr double kMostSteps = 0x1p30;         // of a coordinate

// To nearest, ties to even, for magnitudes up to 2^31: what is added leaves no room for a fraction.
std::int32_t rounded(double x) {
  constexpr double kMagic = 0x1.8p52;
  return static_cast<std::int32_t>((x + kMagic) - kMagic);
}

// The largest coordinate of a position, in steps from the origin.
double most_steps(const std::vector<Vector>& positions, const Executor& executor, const AskedPoints& points) {
  std::mutex merging;
  double most = 0;
  for_ranges(executor, positions.size(), kFewestPoints, [&](std::size_t first, std::size_t last, int) {
    double own = 0;
    for (std::size_t i = first; i < last; ++i) {
      const DVector offset = DVector(positions[i]) - points.origin;
      own = std::max({own, std::fabs(offset.x), std::fabs(offset.y), std::fabs(offset.z)});
    }
    const std::scoped_lock lock(merging);
    most = std::max(most, own);
  });
  return most / points.step;
}

// Half a step for each coordinate, sqrt(3) / 2 < 0.8661 for three; a position's difference from the origin is rounded
// by 2^-53 of at most 2^30 steps.
constexpr double kRoundingError = 0.8662;  // steps

// Makes the step larger: 1 / share, a power of two, times as large.
void coarsen(double share, const Executor& executor, AskedPoints& points) {
  points.step /= share;
  points.error += kRoundingError * points.step;
  for (auto* coordinates : {&points.x, &points.y, &points.z}) {
    for_ranges(executor, coordinates->size(), kFewestPoints, [&](std::size_t first, std::size_t last, int) {
      for (std::size_t i = first; i < last; ++i) (*coordinates)[i] = rounded((*coordinates)[i] * share);
    });
  }
}

// Without room to spare: there are millions.
template <class Values>
void resize(std::size_t count, Values& values) {
  values.reserve(count);
  values.resize(count);
}

void resize(std::size_t count, SeenPoints& seen) {
  for (auto* coordinates : {&seen.points.x, &seen.points.y, &seen.points.z}) resize(count, *coordinates);
  for (auto* numbers : {&seen.points.faces, &seen.points.samples}) resize(count, *numbers);
  resize(count * seen.stride, seen.masks);
}

}  // namespace

const Vector& MovedPoints::position_of(std::uint32_t number) const {
  const auto place = std::lower_bound(numbers.begin(), numbers.end(), number) - numbers.begin();
  return positions[static_cast<std::size_t>(place)];
}

void add_places(MovedPoints& moved, SeenPoints& seen) {
  if (moved.owners.empty()) return;
  const std::size_t first = seen.points.size();
  resize(first + moved.owners.size(), seen);
  moved.numbers.resize(moved.owners.size());
  std::iota(moved.numbers.begin(), moved.numbers.end(), static_cast<std::uint32_t>(first));
  for (std::size_t k = 0; k < moved.owners.size(); ++k) {
    seen.points.samples[first + k] = seen.points.samples[moved.owners[k]];
    seen.points.faces[first + k] = seen.points.faces[moved.owners[k]];
  }
}

void put_in_place(const MovedPoints& moved, const Executor& executor, AskedPoints& points) {
  const double most = most_steps(moved.positions, executor, points);
  double share = 1;
  while (most * share >= kMostSteps) share *= 0.5;
  if (share < 1) coarsen(share, executor, points);
  points.error = std::max(points.error, kRoundingError * points.step);
  for_ranges(executor, moved.numbers.size(), kFewestPoints, [&](std::size_t first, std::size_t last, int) {
    for (std::size_t k = first; k < last; ++k) {
      const std::uint32_t i = moved.numbers[k];
      const DVector steps = (DVector(moved.positions[k]) - points.origin) * (1 / points.step);
      points.x[i] = rounded(steps.x);
      points.y[i] = rounded(steps.y);
      points.z[i] = rounded(steps.z);
      points.faces[i] = kNoOwnFace;
    }
  });
}

void give_back(const MovedPoints& moved, SeenPoints& seen) {
  if (moved.numbers.empty()) return;
  const std::size_t stride = seen.stride;
  for (std::size_t k = 0; k < moved.numbers.size(); ++k) {
    for (std::size_t byte = 0; byte < stride; ++byte) {
      seen.masks[moved.owners[k] * stride + byte] |= seen.masks[moved.numbers[k] * stride + byte];
    }
  }
  resize(moved.numbers.front(), seen);
}

}  // namespace facemap
