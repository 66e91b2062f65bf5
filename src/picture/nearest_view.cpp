#include "picture/nearest_view.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "map/face_planes.h"
#include "math/dvector.h"

namespace facemap {
namespace {

constexpr double kFloatHalfUlp = 0x1p-24;
constexpr double kDoubleHalfUlp = 0x1p-53;

// Distance between a ray and the direction of its sample's centre, of unit length: components rounded to float32, and
// what doubles lose on the way.
constexpr double kRayError = kFloatHalfUlp * (1 + 0x1p-10) + 0x1p-40;

// The kernels' bounds need angles that differ little from their sines.
constexpr double kLargestTilt = 1.0 / 16;

// Samples a ray may pass from its centre: beyond that most edges would be left open.
constexpr double kLargestShift = 0.25;

void store(const DVector& axis, double length, double row[3]) {
  row[0] = axis.x * length;
  row[1] = axis.y * length;
  row[2] = axis.z * length;
}

// Bounds of a ray's (u, v) about its sample's centre. With l the unit direction of the centre and e the error,
// (l.x + e.x)/(l.z + e.z) - l.x/l.z = (e.x - (l.x/l.z) e.z)/(l.z + e.z), at most |e| sqrt(1 + (l.x/l.z)^2) stretch /
// (1 - |e| stretch), where stretch = 1/l.z, largest in the corners.
double largest_shift(double f, double half_columns, double half_rows, double stretch) {
  const double steepest = std::max(half_columns, half_rows) / f;
  const double tangent = kRayError * stretch * std::sqrt(1 + steepest * steepest) / (1 - kRayError * stretch);
  return tangent * f * (1 + 0x1p-10) + (half_columns + half_rows + f) * 0x1p-40;
}

// Points are given where |u|, |v| <= limit, so where |p - K| <= reach Z. The difference, the rows, products and sums
// are off by 5 k f |p - K| in X and Y and 5 k |p - K| in Z, k = 2^-24; the division adds one rounding.
void set_vertices(PlaneView& view, double f, double limit, double half_columns, double half_rows) {
  simd::VertexFrame& v = view.vertices;
  for (int i = 0; i < 3; ++i) {
    v.origin[i] = static_cast<float>(view.planes.origin[i]);
    for (int j = 0; j < 3; ++j) v.rows[i][j] = static_cast<float>(view.planes.rows[i][j]);
  }
  v.unit = static_cast<float>(view.planes.unit);
  v.limit = static_cast<float>(limit);
  v.edge_u = static_cast<float>(half_columns + 1);
  v.edge_v = static_cast<float>(half_rows + 1);
  v.slack_u = float_above(16 * kFloatHalfUlp * (f + half_columns + 1));
  v.slack_v = float_above(16 * kFloatHalfUlp * (f + half_rows + 1));
  v.slack_z = float_above(16 * kFloatHalfUlp);
}

}  // namespace

double unit_for(double largest) {
  const double length = std::clamp(largest, 0x1p-100, 0x1p100);  // within what float32 can hold of it
  return std::bit_cast<double>((2046 - (std::bit_cast<std::uint64_t>(length) >> 52)) << 52);
}

std::optional<PlaneView> plane_view(const Scene& scene, const SampleGrid& grid) {
  const Projection* projection = grid.lens.projection();
  if (projection == nullptr || projection->kind() != ProjectionKind::Plane) return std::nullopt;
  const double half_columns = grid.columns_of_picture() * 0.5, half_rows = grid.rows_of_picture() * 0.5;
  const double f = grid.per_side / projection->texel_angle();  // samples a unit of X/Z or Y/Z
  const double x = half_columns / f, y = half_rows / f, stretch = std::sqrt(1 + x * x + y * y);
  const double limit = 2 * std::max(half_columns, half_rows) + 1;
  const double reach = std::sqrt(1 + 2 * limit * limit / (f * f));
  if (!(kRayError * stretch < kLargestTilt) || !(6 * kFloatHalfUlp * reach < kLargestTilt)) return std::nullopt;
  const double shift = largest_shift(f, half_columns, half_rows, stretch);
  if (!(shift <= kLargestShift)) return std::nullopt;

  PlaneView view;
  const SpaceVector& frame = grid.frame;
  const double unit = unit_for(length(scene.centre() - DVector(frame.position())) + scene.bounding_radius());
  simd::PlaneFrame& planes = view.planes;
  for (int i = 0; i < 3; ++i) planes.origin[i] = frame.position()[i];
  store(frame.axis_x(), f * unit, planes.rows[0]);
  store(frame.axis_y(), -f * unit, planes.rows[1]);
  store(frame.axis_z(), unit, planes.rows[2]);
  planes.unit = unit;
  planes.shift = shift;
  planes.value_error = 64 * kDoubleHalfUlp * f * (half_columns + half_rows + f);
  planes.determinant_error = 128 * kDoubleHalfUlp * f * f;

  set_vertices(view, f, limit, half_columns, half_rows);
  view.first_u = grid.first_column + 0.5 - half_columns;
  view.first_v = grid.first_row + 0.5 - half_rows;
  simd::BoxRules& boxes = view.boxes;
  boxes.first_column = static_cast<float>(view.first_u);
  boxes.first_row = static_cast<float>(view.first_v);
  const double point_error = 6 * kFloatHalfUlp * (f + limit) * reach + 2 * kFloatHalfUlp * limit;
  const double box_error = 8 * kFloatHalfUlp * (limit + half_columns + half_rows);
  boxes.margin = float_above(point_error + box_error + shift);
  boxes.edge_u = float_above(half_columns + 1 + boxes.margin);  // of the same planes as those of vertices
  boxes.edge_v = float_above(half_rows + 1 + boxes.margin);
  boxes.columns = grid.columns();
  boxes.rows = grid.rows();
  return view;
}

}  // namespace facemap
