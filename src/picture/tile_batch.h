#pragma once

#include <facemap/scene.h>

#include <cstdint>

#include "picture/face_slots.h"
#include "picture/nearest_faces.h"
#include "picture/point_box.h"
#include "picture/ray_table.h"

namespace facemap {

/// The samples of one tile of a picture that see a face, and where their rays meet it. Working memory of one thread.
class TileBatch {
 public:
  /// Samples a side of a tile. In a tile samples stand block by block: neighbours in the picture stay neighbours.
  static constexpr int kTile = 16;
  static_assert(kTile * kTile == simd::kSeenBatch);
  static constexpr int kSparse = kTile * 64;

  /// All must outlive it; `rays` are those of `grid`.
  TileBatch(const Scene& scene, const SampleGrid& grid, const NearestFaces& nearest, const RayTable& rays);

  /// Takes the tile whose first sample is at (column, row).
  void collect(int column, int row);

  /// Takes at most one sample of every 8 x 8 of kSparse columns and kTile rows.
  void collect_some(int column, int row);

  /// Fills rays().offset with the points less `origin`, to within `allowed` (world units) and what meet_planes rounds.
  void find_offsets(const Vector& origin, double allowed);

  /// Box of the offsets of a batch that is not empty.
  PointBox box() const;

  std::size_t size() const { return rays_.count; }
  const std::uint32_t* samples() const { return samples_; }
  const std::uint32_t* faces() const { return faces_; }
  const simd::RayBatch& rays() const { return rays_; }

  /// The faces of the batch, set up; rays().slots says which is whose.
  const FaceSlots& slots() const { return slots_; }

 private:
  void add(int row, int column);
  void sharpen(const Vector& origin, std::size_t i);

  const Scene& scene_;
  const SampleGrid& grid_;
  const NearestFaces& nearest_;
  const RayTable& table_;
  FaceSlots slots_;
  simd::RayBatch rays_;
  std::uint32_t samples_[simd::kSeenBatch];
  std::uint32_t faces_[simd::kSeenBatch];
  std::uint8_t is_sharp_[simd::kSeenBatch];
};

}  // namespace facemap
