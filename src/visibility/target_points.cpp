#include "visibility/target_points.h"

#include <facemap/error.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>

namespace facemap {
namespace {

constexpr std::size_t kFewestPoints = 16384;  // a task

// Coordinates are rounded to steps: at most 2^30 of them from the middle.
constexpr double kMostSteps = 0x1p30;

// Half a step for each coordinate, sqrt(3) / 2 < 0.8661 for three; a point's difference from the middle is rounded by
// 2^-53 of at most 2^30 steps.
constexpr double kRoundingError = 0.8662;  // steps

// To nearest, ties to even, for magnitudes up to 2^31: what is added leaves no room for a fraction.
std::int32_t rounded(double x) {
  constexpr double kMagic = 0x1.8p52;
  return static_cast<std::int32_t>((x + kMagic) - kMagic);
}

struct Box {
  Vector lower{HUGE_VALF}, upper{-HUGE_VALF};
};

// Throws Error if a point is not finite.
Box box_of(std::span<const Vector> points, const Executor& executor) {
  Box box;
  std::mutex merging;
  for_ranges(executor, points.size(), kFewestPoints, [&](std::size_t first, std::size_t last, int) {
    Box own;
    float sum = 0;  // 0 times what is finite
    for (std::size_t i = first; i < last; ++i) {
      for (int k = 0; k < 3; ++k) {
        own.lower[k] = std::min(own.lower[k], points[i][k]);
        own.upper[k] = std::max(own.upper[k], points[i][k]);
        sum += 0 * points[i][k];
      }
    }
    if (!(sum == 0)) throw Error("a point is not finite");
    const std::scoped_lock lock(merging);
    for (int k = 0; k < 3; ++k) {
      box.lower[k] = std::min(box.lower[k], own.lower[k]);
      box.upper[k] = std::max(box.upper[k], own.upper[k]);
    }
  });
  return box;
}

// A power of two, above 0, of which `reach` is at most 2^30.
double step_for(double reach) {
  int exponent;
  std::frexp(reach / kMostSteps, &exponent);
  return std::ldexp(1.0, std::max(exponent, -1000));
}

}  // namespace

AskedPoints asked_points(const Scene& scene, const Viewpoint::Targets& targets, std::size_t first, std::size_t last,
                         const Executor& executor) {
  const std::span<const Vector> some = targets.points.subspan(first, last - first);
  AskedPoints asked;
  if (some.empty()) return asked;
  const Box box = box_of(some, executor);
  double reach = 0;
  for (int k = 0; k < 3; ++k) {
    asked.origin[k] = 0.5 * (double{box.lower[k]} + double{box.upper[k]});
    reach = std::max({reach, double{box.upper[k]} - asked.origin[k], asked.origin[k] - double{box.lower[k]}});
  }
  asked.step = step_for(reach);
  asked.error = kRoundingError * asked.step;
  for (auto* coordinates : {&asked.x, &asked.y, &asked.z}) coordinates->resize(some.size());
  asked.faces.resize(some.size());
  for_ranges(executor, some.size(), kFewestPoints, [&](std::size_t begin, std::size_t end, int) {
    const double per_step = 1 / asked.step;
    for (std::size_t i = begin; i < end; ++i) {
      const DVector steps = (DVector(some[i]) - asked.origin) * per_step;
      asked.x[i] = rounded(steps.x);
      asked.y[i] = rounded(steps.y);
      asked.z[i] = rounded(steps.z);
    }
    for (std::size_t i = begin; i < end; ++i) {
      const FaceId face = targets.faces.empty() ? kNoFace : targets.faces[first + i];
      if (face != kNoFace && (face < 0 || static_cast<std::size_t>(face) >= scene.face_count())) {
        throw Error("point " + std::to_string(first + i) + " lies on face " + std::to_string(face) +
                    ", and there are " + std::to_string(scene.face_count()));
      }
      asked.faces[i] = face == kNoFace ? kNoOwnFace : static_cast<std::uint32_t>(face);
    }
  });
  return asked;
}

}  // namespace facemap
