#include "map/edge_curve.h"

#include <algorithm>
#include <cmath>

namespace facemap {
namespace {

// Halvings of one edge. A double has 53 bits, so after 64 even an edge whose one end is 2^10 times nearer than its
// length has no new midpoint. Only an edge across the antipode gets here, and by one branch: 64 points.
constexpr int kDeepestBisection = 64;

constexpr double kPixel = 1;

double distance_to_raster(const MapPoint& p, const Projection& projection) {
  const double dx = std::max({0.0, -p.x, p.x - projection.width()});
  const double dy = std::max({0.0, -p.y, p.y - projection.height()});
  return std::max(dx, dy);
}

// Departs: Alg. 2 allows one pixel everywhere. Outside the raster nothing is drawn, and a chord that is shorter
// than its distance to the raster goes round it on the same side as the curve; without this an edge behind a camera
// of one degree would cost a million points.
bool is_close(const MapPoint& a, const MapPoint& b, const Projection& projection) {
  const double away = std::min(distance_to_raster(a, projection), distance_to_raster(b, projection));
  const double dx = a.x - b.x, dy = a.y - b.y;
  return std::sqrt(dx * dx + dy * dy) <= std::max(kPixel, away / 2);
}

// Wang 2022, Alg. 2, part (2): the points strictly between the two.
void append_between(const CurvePoint& a, const CurvePoint& b, int depth, const Projection& projection,
                    std::vector<MapPoint>& curve) {
  if (depth == kDeepestBisection || is_close(a.map, b.map, projection)) return;
  const DVector middle = (a.local + b.local) * 0.5;
  if (!projection.is_mapped(middle)) return;
  const CurvePoint m{middle, projection.map_from_local(middle)};
  append_between(a, m, depth + 1, projection, curve);
  curve.push_back(m.map);
  append_between(m, b, depth + 1, projection, curve);
}

}  // namespace

// Wang 2022, Alg. 2, part (1).
void append_edge_curve(const CurvePoint& a, const CurvePoint& b, const Projection& projection,
                       std::vector<MapPoint>& curve) {
  curve.push_back(a.map);
  append_between(a, b, 0, projection, curve);
  // Departs: as printed the second endpoint is added to short edges alone. It is the next edge's first.
}

}  // namespace facemap
