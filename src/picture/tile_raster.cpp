#include "picture/tile_raster.h"

#include <algorithm>

#include "map/face_planes.h"
#include "math/exact_sign.h"
#include "picture/nearest_contests.h"
#include "simd/nearest_blocks.h"
#include "simd/nearest_tile.h"

namespace facemap {

void TileRaster::Pending::add(const TileFace& f) {
  faces[count] = f.face;
  x0[count] = f.x0;
  x1[count] = f.x1;
  y0[count] = f.y0;
  y1[count] = f.y1;
  ++count;
}

void TileRaster::draw(const TileArea& tile, std::span<const TileFace> faces, NearestFaces& nearest,
                      std::vector<std::uint32_t>& loose, Counters& counters) {
  std::fill_n(w_, static_cast<std::size_t>(row_samples_) * row_samples_ / simd::kBlockSamples, 0.0f);
  contests_.clear();
  for (const TileFace& face : faces) add(face);
  for (int c = 0; c <= kClasses; ++c) flush(c);
  const std::size_t contested =
      resolve_contests(scene_, grid_, {tile.first_column, tile.first_row}, target(side_), loose, &counters);
  counters.by_float += static_cast<std::size_t>(tile.rows) * static_cast<std::size_t>(tile.columns) - contested;
  const auto columns = static_cast<std::size_t>(grid_.columns());
  const std::size_t first_sample =
      static_cast<std::size_t>(tile.first_row) * columns + static_cast<std::size_t>(tile.first_column);
  simd::copy_rows(target(tile.rows), static_cast<std::size_t>(tile.columns), nearest.faces.data() + first_sample,
                  columns);
}

void TileRaster::add(const TileFace& face) {
  const int samples = (face.x1 - face.x0 + 1) * (face.y1 - face.y0 + 1);
  int c = 0;
  while (c < kClasses && samples > kClassSamples[c]) ++c;
  pending_[c].add(face);
  if (pending_[c].count == simd::kBlockFaces) flush(c);
}

void TileRaster::flush(int c) {
  Pending& pending = pending_[c];
  if (pending.count == 0) return;
  const simd::FaceBoxes boxes = pending.boxes();
  const simd::TilePoints points = {plane.u, plane.v};
  simd::FaceBlock block;
  simd::set_up_tile_faces(source_, plane.frame, plane.reach, boxes.faces, boxes.count, nullptr, block);
  if (c < kClasses) simd::draw_tile_faces(block, boxes, points, target(side_));
  for (std::size_t k = 0; k < boxes.count; ++k) {
    if (block.is_unsure[k]) {
      draw_edge_on(boxes, k);
    } else if (c == kClasses) {
      simd::draw_tile_face(block, boxes, k, points, target(side_));
    }
  }
  pending.count = 0;
}

// A face whose side doubles cannot tell: nothing if it is seen exactly edge-on.
void TileRaster::draw_edge_on(const simd::FaceBoxes& boxes, std::size_t k) {
  const auto s = static_cast<std::int8_t>(side(triangle_of(scene_, boxes.faces[k]), grid_.frame.position()));
  if (s == 0) return;
  const simd::FaceBoxes one = {boxes.faces + k, boxes.x0 + k, boxes.x1 + k, boxes.y0 + k, boxes.y1 + k, 1};
  simd::FaceBlock block;
  simd::set_up_tile_faces(source_, plane.frame, plane.reach, one.faces, 1, &s, block);
  simd::draw_tile_face(block, one, 0, {plane.u, plane.v}, target(side_));
}

}  // namespace facemap
