#include "visibility/point_parts.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "math/dvector.h"

namespace facemap {
namespace {

constexpr std::size_t kFewestPoints = 32768;  // a task
constexpr std::size_t kSampledPoints = 1024;

// A sampled point within 80 degrees of the middle of all is in front of the origin.
constexpr double kLeastCosine = 0.17;

// Steps times three factors, and what is added.
struct Form {
  float x, y, z, at;

  float operator()(std::int32_t px, std::int32_t py, std::int32_t pz) const {
    return x * static_cast<float>(px) + y * static_cast<float>(py) + z * static_cast<float>(pz) + at;
  }
};

// Offsets from the origin along a direction, in steps.
Form form_along(const DVector& direction, const AskedPoints& points, const Vector& origin) {
  const double at = dot(direction, points.origin - DVector(origin)) / points.step;
  return {static_cast<float>(direction.x), static_cast<float>(direction.y), static_cast<float>(direction.z),
          static_cast<float>(at)};
}

std::vector<DVector> sample_directions(const AskedPoints& points, const Vector& origin) {
  std::vector<DVector> directions;
  for (std::size_t i = 0; i < points.size(); i += points.size() / kSampledPoints + 1) {
    const DVector direction = normalized(place_of(points, static_cast<std::uint32_t>(i)) - DVector(origin));
    if (direction != DVector(0)) directions.push_back(direction);
  }
  return directions;
}

template <class BitOf>
PointParts share(const AskedPoints& points, int count, const Executor& executor, const BitOf& bit_of) {
  PointParts parts{count, {}};
  parts.bits.resize(points.size());
  for_ranges(executor, points.size(), kFewestPoints, [&](std::size_t first, std::size_t last, int) {
    const std::int32_t *x = points.x.data(), *y = points.y.data(), *z = points.z.data();
    std::uint8_t* bits = parts.bits.data();
    for (std::size_t i = first; i < last; ++i) bits[i] = static_cast<std::uint8_t>(bit_of(x[i], y[i], z[i]));
  });
  return parts;
}

// Wedges about a line through the origin, between planes that part the sample evenly.
PointParts share_by_wedges(const AskedPoints& points, const Vector& origin, int wanted, const Executor& executor,
                           const std::vector<DVector>& sample, const DVector& axis) {
  const DVector aside = std::fabs(axis.y) < 0.9 ? DVector(0, 1, 0) : DVector(1, 0, 0);
  const DVector right = normalized(cross(aside, axis));
  std::vector<double> slopes;
  for (const DVector& direction : sample) slopes.push_back(dot(direction, right) / dot(direction, axis));
  std::sort(slopes.begin(), slopes.end());
  Form planes[kMostPointParts - 1] = {};
  for (int k = 1; k < wanted; ++k) {
    const auto at = slopes.size() * static_cast<std::size_t>(k) / static_cast<std::size_t>(wanted);
    planes[k - 1] = form_along(right - slopes[at] * axis, points, origin);
  }
  return share(points, wanted, executor, [=](std::int32_t x, std::int32_t y, std::int32_t z) {
    int bit = 1;
    for (int k = 0; k + 1 < wanted; ++k) bit <<= planes[k](x, y, z) > 0 ? 1 : 0;
    return bit;
  });
}

PointParts share_by_sides(const AskedPoints& points, const Vector& origin, const Executor& executor) {
  const Form along_x = form_along({1, 0, 0}, points, origin), along_y = form_along({0, 1, 0}, points, origin),
             along_z = form_along({0, 0, 1}, points, origin);
  return share(points, 6, executor, [=](std::int32_t x, std::int32_t y, std::int32_t z) {
    const float X = along_x(x, y, z), Y = along_y(x, y, z), Z = along_z(x, y, z);
    const float size_x = std::fabs(X), size_y = std::fabs(Y), size_z = std::fabs(Z);
    const int of_x = X < 0 ? 2 : 1, of_y = Y < 0 ? 8 : 4, of_z = Z < 0 ? 32 : 16;
    return size_z > std::max(size_x, size_y) ? of_z : size_y > size_x ? of_y : of_x;
  });
}

}  // namespace

PointParts share_points(const AskedPoints& points, const Vector& origin, int wanted, const Executor& executor) {
  const std::vector<DVector> sample = sample_directions(points, origin);
  DVector sum(0);
  for (const DVector& direction : sample) sum += direction;
  const DVector axis = normalized(sum);
  const bool is_in_front = axis != DVector(0) && std::all_of(sample.begin(), sample.end(), [&](const DVector& d) {
                             return dot(d, axis) > kLeastCosine;
                           });
  return is_in_front ? share_by_wedges(points, origin, wanted, executor, sample, axis)
                     : share_by_sides(points, origin, executor);
}

}  // namespace facemap
