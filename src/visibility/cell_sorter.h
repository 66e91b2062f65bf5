#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "picture/asked_points.h"
#include "picture/light_bounds.h"
#include "picture/unset_vector.h"
#include "simd/shadow_frame.h"
#include "visibility/point_question.h"
#include "visibility/spares.h"

namespace facemap {

/// The cells that a raster about an origin is cut into, row by row; and one for points that may be hidden, but of which
/// the raster says nothing, or that are to ask all faces.
inline constexpr int kCellsASide = 16;
inline constexpr std::size_t kOddCell = std::size_t{kCellsASide} * kCellsASide, kCellCount = kOddCell + 1;

/// Working memory of a task.
struct CellScratch {
  AskedPoints points;
  UnsetVector<std::uint8_t> dark;
  std::vector<std::uint32_t> open, cells, depths;

  std::size_t memory_bytes() const noexcept;
};

/// How targets lie about an origin that has all faces in front of it.
class CellSorter {
 public:
  /// `bounds` or null: kept ones, whose frame it is. They decide points beforehand.
  CellSorter(const simd::ShadowFrame& frame, const LightBounds* bounds);

  /// Targets whose cells are found together, at most.
  static constexpr std::size_t kPiece = std::size_t{1} << 14;

  /// Sets question.visible of the targets from `first` up to `last` to 0 where they are hidden for certain, else to 1.
  /// Writes the numbers of those that faces are to be asked about, less `first`, and their cells. Returns how many.
  std::size_t find_cells(const PointQuestion& question, std::size_t first, std::size_t last, CellScratch& scratch,
                         std::uint16_t* numbers, std::uint16_t* cells) const;

 private:
  simd::ShadowFrame frame_;
  const LightBounds* bounds_;
  std::vector<std::uint32_t> no_bounds_;
  simd::TexelBounds texels_;
};

}  // namespace facemap
