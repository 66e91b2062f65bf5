#pragma once

#include <cstdint>
#include <vector>

#include "picture/working_memory.h"
#include "simd/shadow_faces.h"
#include "simd/shadow_points.h"
#include "simd/shadow_tests.h"

namespace facemap {

/// The points of one raster, sorted by texel into blocks of sixteen, with what the faces run over needs to know of
/// them. They stand in the memory that they were sorted with.
class ShadowPoints {
 public:
  /// What sorting `count` points takes, their list apart.
  static std::size_t bytes_for(std::size_t count, std::size_t faces);

  /// Sorts a list of points, whose memory is used up. Appends to `rest` the numbers of those that have no place on the
  /// raster. `own_faces`: of all points. `faces`: how many are to be held against them.
  void sort(const simd::ListedPoints& list, const simd::PointTransform& transform, const std::uint32_t* own_faces,
            std::size_t faces, WorkingMemory& memory, std::vector<std::uint32_t>& rest);

  std::size_t count() const noexcept { return count_; }
  simd::ShadowRaster raster() const noexcept { return raster_; }
  /// As FacesToSift::occupied.
  const std::uint8_t* occupied() const noexcept { return occupied_; }
  const simd::FarthestPyramid& farthest() const noexcept { return pyramid_; }
  simd::SortedPoints sorted() noexcept;

  std::uint32_t point_at(std::uint32_t place) const { return point_of_place_[place]; }
  bool is_blocked(std::uint32_t place) const { return (blocked_[place / 16] >> (place % 16) & 1) != 0; }
  /// Of the sixteen places from `first`, a multiple of 16, on: one bit a point, places without a point left out.
  std::uint32_t blocked_from(std::size_t first) const {
    const std::size_t left = count_ - first;
    return blocked_[first / 16] & (left < 16 ? (1u << left) - 1 : 0xffffu);
  }
  void set_blocked(std::uint32_t place) {
    blocked_[place / 16] = static_cast<std::uint16_t>(blocked_[place / 16] | 1u << (place % 16));
  }

  std::size_t memory_bytes() const noexcept;

 private:
  std::size_t texel_count() const {
    return static_cast<std::size_t>(raster_.columns) * static_cast<std::size_t>(raster_.rows);
  }
  simd::ProjectedPoints project(const simd::ListedPoints& list, const simd::PointTransform& transform,
                                WorkingMemory& memory, std::vector<std::uint32_t>& rest);
  void fill_blocks(const simd::ProjectedPoints& points, const std::uint32_t* own_faces, WorkingMemory& memory);
  void build_pyramid();

  simd::ShadowRaster raster_;
  std::size_t count_ = 0;
  std::size_t block_count_ = 0;
  std::uint32_t* point_of_place_ = nullptr;
  std::uint32_t* begins_ = nullptr;  ///< of each texel its first place, and one more
  simd::ShadowBlock* blocks_ = nullptr;
  float* farthest_of_block_ = nullptr;
  std::vector<std::uint16_t> blocked_;
  std::vector<float> cells_;
  std::uint8_t* occupied_ = nullptr;
  simd::FarthestPyramid pyramid_{};
};

}  // namespace facemap
