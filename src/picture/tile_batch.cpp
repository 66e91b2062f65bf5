#include "picture/tile_batch.h"

#include <algorithm>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "simd/seen_samples.h"

namespace facemap {
namespace {

constexpr int kCell = 8;

// splitmix64's mixing (Steele, Lea, Flood 2014).
std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

}  // namespace

TileBatch::TileBatch(const Scene& scene, const SampleGrid& grid, const NearestFaces& nearest, const RayTable& rays)
    : scene_(scene), grid_(grid), nearest_(nearest), table_(rays), slots_(scene.mesh()) {}

void TileBatch::collect(int column, int row) {
  rays_.count = 0;
  const int end_column = std::min(column + kTile, grid_.columns()), end_row = std::min(row + kTile, grid_.rows());
  if ((end_column - column) % simd::kRunColumns == 0) {
    const auto x = static_cast<std::size_t>(column), y = static_cast<std::size_t>(row), stride = table_.columns.size();
    const std::size_t first = y * stride + x;
    const simd::TileFaces tile = {nearest_.faces.data() + first, stride, static_cast<std::uint32_t>(first),
                                  table_.columns.data() + x, table_.rows.data() + y};
    rays_.count =
        simd::list_samples(tile, end_column - column, end_row - row, {samples_, faces_, rays_.map_x, rays_.map_y});
    return;
  }
  for (int left = column; left < end_column; left += simd::kRunColumns) {
    for (int j = row; j < end_row; ++j) {
      for (int i = left; i < std::min(left + simd::kRunColumns, end_column); ++i) add(j, i);
    }
  }
}

// The place in a cell varies, so that no pattern of the picture hides from it.
void TileBatch::collect_some(int column, int row) {
  rays_.count = 0;
  static_assert(kSparse / kCell * (kTile / kCell) <= simd::kSeenBatch);
  for (int top = row; top < row + kTile; top += kCell) {
    for (int left = column; left < std::min(column + kSparse, grid_.columns()); left += kCell) {
      const auto cell = static_cast<std::uint64_t>(top) << 32 | static_cast<std::uint64_t>(left);
      const int place = static_cast<int>(mixed(cell) % (kCell * kCell));
      const int i = left + place % kCell, j = top + place / kCell;
      if (i < grid_.columns() && j < grid_.rows()) add(j, i);
    }
  }
}

// The sample if it sees a face. No branch: edges of shapes are hard to predict.
void TileBatch::add(int row, int column) {
  const auto x = static_cast<std::size_t>(column), y = static_cast<std::size_t>(row);
  const std::size_t sample = y * table_.columns.size() + x, count = rays_.count;
  const FaceId face = nearest_.faces[sample];
  samples_[count] = static_cast<std::uint32_t>(sample);
  faces_[count] = static_cast<std::uint32_t>(face);
  rays_.map_x[count] = table_.columns[x];
  rays_.map_y[count] = table_.rows[y];
  rays_.count = count + (face != kNoFace);
}

void TileBatch::find_offsets(const Vector& origin, double allowed) {
  const Vector& camera = grid_.frame.position();
  const float K[3] = {camera.x, camera.y, camera.z};
  slots_.assign(faces_, rays_.count, rays_.slots);
  simd::set_up_planes(slots_.planes, K);
  table_.find_directions(samples_, rays_);
  const DVector from_origin = DVector(camera) - DVector(origin);
  const double base[3] = {from_origin.x, from_origin.y, from_origin.z};
  if (!simd::meet_planes(slots_.planes, base, allowed, rays_, is_sharp_)) return;
  for (std::size_t i = 0; i < rays_.count; ++i) {
    if (!is_sharp_[i]) sharpen(origin, i);
  }
}

// Where doubles leave too much open, as for rays that graze a face: to kDirectionError of the offset.
void TileBatch::sharpen(const Vector& origin, std::size_t i) {
  const Triangle face = triangle_of(scene_, faces_[i]);
  const Vector& camera = grid_.frame.position();
  const Vector direction(rays_.direction[0][i], rays_.direction[1][i], rays_.direction[2][i]);
  const TruePoint point{camera, direction, face, side(face, camera)};
  const DVector offset = offset_from(origin, point, ray_parameter(point));
  for (int axis = 0; axis < 3; ++axis) rays_.offset[axis][i] = offset[axis];
}

PointBox TileBatch::box() const {
  PointBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const auto [least, most] = std::minmax_element(rays_.offset[axis], rays_.offset[axis] + rays_.count);
    box.lower[axis] = *least;
    box.upper[axis] = *most;
  }
  return box;
}

}  // namespace facemap
