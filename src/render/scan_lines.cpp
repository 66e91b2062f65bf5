#include "render/scan_lines.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace facemap {
namespace {

// First index i in 0..size whose sample i + offset is at or after `edge`.
int first_sample(double edge, double offset, int size) {
  return static_cast<int>(std::ceil(std::clamp(edge - offset, 0.0, static_cast<double>(size))));
}

struct Crossing {
  double x, depth;
};

// Where an edge with y1 <= y < y2 meets the line y. Neighbours walk a common edge in opposite directions; from its
// upper end both get the same bits.
Crossing cross_line(const DVector& upper, const DVector& lower, double y) {
  const double share = (y - upper.y) / (lower.y - upper.y);
  // Wang 2022, eq. (3). Departs: printed as x = x2 + (x2 - x1)(y - y1)/(y2 - y1), which is x2 at y1 and beyond both
  // ends after; the base point is x1.
  return {upper.x + (lower.x - upper.x) * share, upper.z + (lower.z - upper.z) * share};
}

// The left and the right crossing of a convex polygon with the line y; false if it has none.
bool cross_polygon(std::span<const DVector> polygon, double y, Crossing& left, Crossing& right) {
  int count = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const DVector* upper = &polygon[i];
    const DVector* lower = &polygon[(i + 1) % polygon.size()];
    if (upper->y > lower->y) std::swap(upper, lower);
    if (!(upper->y <= y && y < lower->y)) continue;
    const Crossing c = cross_line(*upper, *lower, y);
    if (count == 0 || c.x < left.x) left = c;
    if (count == 0 || c.x > right.x) right = c;
    ++count;
  }
  return count > 1;
}

void fill_span(const Crossing& left, const Crossing& right, int row, FaceId face, const PixelMask& mask,
               ScreenSamples& samples) {
  const int begin = first_sample(left.x, samples.x, samples.width);
  const int end = first_sample(right.x, samples.x, samples.width);
  for (int column = begin; column < end; ++column) {
    const std::size_t pixel = static_cast<std::size_t>(row) * samples.width + column;
    if (!mask.empty() && mask[pixel] == 0) continue;
    const double share = (column + samples.x - left.x) / (right.x - left.x);
    const double depth = left.depth + (right.depth - left.depth) * share;
    if (!(depth < samples.depths[pixel])) continue;
    samples.depths[pixel] = depth;
    samples.faces[pixel] = face;
  }
}

}  // namespace

ScreenSamples::ScreenSamples(int width_in, int height_in, double x_in, double y_in)
    : width(width_in),
      height(height_in),
      x(x_in),
      y(y_in),
      depths(static_cast<std::size_t>(width_in) * height_in, 1.0),
      faces(static_cast<std::size_t>(width_in) * height_in, kNoFace) {}

void fill_scan_lines(std::span<const DVector> polygon, FaceId face, const PixelMask& mask, ScreenSamples& samples) {
  if (polygon.empty()) return;
  // Wang 2022, Alg. 1, step (1)
  double highest = polygon[0].y, lowest = polygon[0].y;
  for (const DVector& p : polygon) {
    highest = std::min(highest, p.y);
    lowest = std::max(lowest, p.y);
  }
  // Alg. 1, step (2)
  const int end = first_sample(lowest, samples.y, samples.height);
  for (int row = first_sample(highest, samples.y, samples.height); row < end; ++row) {
    Crossing left{}, right{};
    if (cross_polygon(polygon, row + samples.y, left, right)) fill_span(left, right, row, face, mask, samples);
  }
}

}  // namespace facemap
