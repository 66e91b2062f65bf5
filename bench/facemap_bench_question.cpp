#include "facemap_bench_question.h"

#include <bit>

namespace facemap::bench {

Rays::Rays(const View& view, int columns, int rows, int samples)
    : columns_(columns), rows_(rows), origin_(view.position) {
  const Projection projection(view.projection, view.field_angle, columns / samples, rows / samples);
  const SpaceVector frame = SpaceVector::looking_at(view.position, view.look_at, view.up);
  const auto centre = [samples](int i) { return i / samples + (i % samples + 0.5) / samples; };
  directions_.resize(std::size_t(tile_count()) * kTile * kTile * 3);
  for (int t = 0; t < tile_count(); ++t) {
    for (int i = 0; i < kTile * kTile; ++i) {
      const InTile place = place_in_tile(i);
      const int x = t % tiles_across() * kTile + place.column, y = t / tiles_across() * kTile + place.row;
      const MapPoint point(centre(x), centre(y));
      if (x >= columns || y >= rows || !projection.has_direction(point)) continue;
      const Vector d(frame.world_from_local(projection.local_from_map(point)));
      float* block = &directions_[(std::size_t(t) * kTile * kTile + i / kBlock * kBlock) * 3];
      for (int axis = 0; axis < 3; ++axis) block[axis * kBlock + i % kBlock] = d[axis];
    }
  }
}

Answer::Answer(int columns_, int rows_, int light_count_)
    : columns(columns_),
      rows(rows_),
      light_count(light_count_),
      ids(std::make_unique_for_overwrite<FaceId[]>(count())),
      lights(std::make_unique_for_overwrite<std::uint8_t[]>(count() * light_bytes())) {}

Difference compare(const Image& ours, const Answer& theirs) {
  Difference difference;
  difference.samples = theirs.count();
  const std::size_t stride = theirs.light_bytes();
  for (std::size_t i = 0; i < theirs.count(); ++i) {
    if (ours.ids[i] != theirs.ids[i]) {
      ++difference.ids;
      difference.where.push_back(i);
      continue;
    }
    if (ours.ids[i] == kNoFace) continue;
    difference.queries += theirs.light_count;
    int bits = 0;
    for (std::size_t b = 0; b < stride; ++b) {
      const unsigned changed = ours.lights[i * stride + b] ^ theirs.lights[i * stride + b];
      bits += std::popcount(changed);
    }
    difference.bits += bits;
    if (bits) difference.where.push_back(i);
  }
  return difference;
}

}  // namespace facemap::bench
