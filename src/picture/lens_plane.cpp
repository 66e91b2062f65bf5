#include "picture/lens_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "simd/seen_rays.h"

namespace facemap {
namespace {

// A corner has a place on a tile's plane if its depth is at least this share of its distance. Then the place is off by
// less than kPlaceError times the plane's samples a radian: the offset's and the rotation's 4 roundings of 2^-53 are
// divided by the share, for u itself (at most f over the share) and for its divisor: 4 (1 + 16) 16 2^-53 < 2^-42.
constexpr double kLeastDepth = 1.0 / 16;
constexpr double kPlaceError = 0x1p-42;

double samples_a_radian(const LensTiles::Tile& tile) {
  return std::clamp(std::max(tile.area.columns, tile.area.rows) / (2 * tile.cap.radius), 1.0, 0x1p20);
}

}  // namespace

// Samples beyond the tile repeat its last row and column; those without a direction take the middle's until then.
void set_plane(const SampleGrid& grid, const LensTiles::Tile& tile, double unit, TilePlane& plane) {
  plane.look_along(tile.cap.centre, samples_a_radian(tile), unit, grid.frame.position());
  const DirectionTable& table = *grid.directions;
  const Vector middle(tile.cap.centre);
  float x[simd::kSeenBatch], y[simd::kSeenBatch], z[simd::kSeenBatch];
  bool has_ray[simd::kSeenBatch];
  constexpr std::size_t kAll = TilePlane::kLargestTile * TilePlane::kLargestTile;
  const auto columns = static_cast<std::size_t>(grid.columns());
  for (std::size_t first = 0; first < kAll; first += simd::kSeenBatch) {
    for (std::size_t i = 0; i < simd::kSeenBatch; ++i) {
      const auto sample = static_cast<std::uint32_t>(first + i);
      const int column = std::min(simd::column_of(kLensRowSamples, sample), tile.area.columns - 1);
      const int row = std::min(simd::row_of(kLensRowSamples, sample), tile.area.rows - 1);
      const Vector d = table.at(static_cast<std::size_t>(tile.area.first_row + row) * columns +
                                static_cast<std::size_t>(tile.area.first_column + column));
      has_ray[i] = d != Vector(0);
      x[i] = has_ray[i] ? d.x : middle.x;
      y[i] = has_ray[i] ? d.y : middle.y;
      z[i] = has_ray[i] ? d.z : middle.z;
    }
    plane.set_points(x, y, z, first, simd::kSeenBatch);
    for (std::size_t i = 0; i < simd::kSeenBatch && !tile.is_whole; ++i) {
      if (!has_ray[i]) plane.u[first + i] = plane.v[first + i] = std::numeric_limits<float>::quiet_NaN();
    }
  }
  plane.set_errors();
}

// The derivatives are taken across the tile's middle; where there is none, or too small a one, faces get the whole
// tile.
TileBoxes::TileBoxes(const LensTiles::Tile& tile, const TilePlane& plane) : plane_(plane) {
  const TileArea& area = tile.area;
  column_.last = area.columns - 1;
  row_.last = area.rows - 1;
  if (column_.last == 0 || row_.last == 0) return;
  const auto difference = [&](const float* values, int x0, int y0, int x1, int y1) {
    return static_cast<double>(values[simd::sample_at(kLensRowSamples, x1, y1)]) -
           values[simd::sample_at(kLensRowSamples, x0, y0)];
  };
  const int x = column_.last / 2, y = row_.last / 2;
  const double across = 1.0 / column_.last, down = 1.0 / row_.last;
  const double u_x = difference(plane.u, 0, y, column_.last, y) * across;
  const double v_x = difference(plane.v, 0, y, column_.last, y) * across;
  const double u_y = difference(plane.u, x, 0, x, row_.last) * down;
  const double v_y = difference(plane.v, x, 0, x, row_.last) * down;
  const double determinant = u_x * v_y - u_y * v_x;
  if (!(std::fabs(determinant) > 0x1p-20 * (std::fabs(u_x * v_y) + std::fabs(u_y * v_x)))) return;
  is_known_ = true;
  column_.u = v_y / determinant;
  column_.v = -u_y / determinant;
  row_.u = -v_x / determinant;
  row_.v = u_x / determinant;
  set_margin(tile, true, column_);
  set_margin(tile, false, row_);
}

// Half the spread of what the samples are off by, about the constant that leaves the least; and what the places of
// rays and corners are.
void TileBoxes::set_margin(const LensTiles::Tile& tile, bool of_columns, Fit& fit) const {
  double least = HUGE_VAL, most = -HUGE_VAL;
  for (int row = 0; row < tile.area.rows; ++row) {
    for (int column = 0; column < tile.area.columns; ++column) {
      const std::uint32_t i = simd::sample_at(kLensRowSamples, column, row);
      const double off = (of_columns ? column : row) - fit.at(plane_.u[i], plane_.v[i]);
      least = off < least ? off : least;  // not for NaN
      most = off > most ? off : most;
    }
  }
  fit.constant = 0.5 * (least + most);
  const double f = plane_.samples_a_radian();
  fit.margin = 0.5 * (most - least) * (1 + 0x1p-40) + 0x1p-40 +
               (std::fabs(fit.u) + std::fabs(fit.v)) * (plane_.frame.shift + kPlaceError * f) * (1 + 0x1p-10);
}

bool TileBoxes::find(const Offsets& corners, TileFace& face) const {
  double x0 = HUGE_VAL, x1 = -HUGE_VAL, y0 = HUGE_VAL, y1 = -HUGE_VAL;
  const auto& rows = plane_.frame.rows;
  bool is_known = is_known_;
  for (const DVector& p : corners) {
    const double z = rows[2][0] * p.x + rows[2][1] * p.y + rows[2][2] * p.z;
    is_known = is_known && z > kLeastDepth * plane_.frame.unit * length(p);
    const double u = (rows[0][0] * p.x + rows[0][1] * p.y + rows[0][2] * p.z) / z;
    const double v = (rows[1][0] * p.x + rows[1][1] * p.y + rows[1][2] * p.z) / z;
    const double x = column_.at(u, v), y = row_.at(u, v);
    x0 = std::min(x0, x);
    x1 = std::max(x1, x);
    y0 = std::min(y0, y);
    y1 = std::max(y1, y);
  }
  face.x0 = face.y0 = 0;
  face.x1 = static_cast<std::uint8_t>(column_.last);
  face.y1 = static_cast<std::uint8_t>(row_.last);
  if (!is_known) return true;
  x0 = std::ceil(std::max(x0 - column_.margin, 0.0));
  x1 = std::floor(std::min(x1 + column_.margin, static_cast<double>(column_.last)));
  y0 = std::ceil(std::max(y0 - row_.margin, 0.0));
  y1 = std::floor(std::min(y1 + row_.margin, static_cast<double>(row_.last)));
  if (!(x0 <= x1 && y0 <= y1)) return false;
  face.x0 = static_cast<std::uint8_t>(x0);
  face.x1 = static_cast<std::uint8_t>(x1);
  face.y0 = static_cast<std::uint8_t>(y0);
  face.y1 = static_cast<std::uint8_t>(y1);
  return true;
}

}  // namespace facemap
