#include "visibility/cell_sorter.h"

#include <algorithm>
#include <cmath>

#include "picture/bytes_of.h"
#include "picture/decide_points.h"
#include "picture/point_projection.h"
#include "simd/bounded_points.h"
#include "visibility/own_face.h"
#include "visibility/target_points.h"

namespace facemap {
namespace {

// What the kernel reaches past the end.
constexpr std::size_t kPadding = 64;

// Points whose own faces are on their way from memory while others are asked.
constexpr std::size_t kAhead = 16;

void prefetch_own(const PointQuestion& question, const AskedPoints& points, std::size_t point) {
  const std::uint32_t own = points.faces[point];
  if (own == kNoOwnFace) return;
  for (const std::uint32_t corner : question.faces.mesh().triangles[own]) {
    __builtin_prefetch(&question.faces.mesh().positions[corner]);
  }
}

// Bounds that leave every point open.
constexpr std::uint32_t kOpen = 0xffff0000u;

// What may be hidden of points without a place on the raster: not what is surely off it, since it holds all faces, or
// behind the plane of the origin, which they are all in front of.
class Behind {
 public:
  Behind(const simd::ShadowFrame& frame, const AskedPoints& points, const PointProjection& projection)
      : frame_(frame), points_(points), from_origin_(projection.from_light), error_(projection.error_in(frame)) {}

  bool may_be(std::uint32_t point) const {
    const DVector offset = from_origin_ + points_.step * DVector(points_.x[point], points_.y[point], points_.z[point]);
    double place[3] = {};
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) place[i] += frame_.rows[i][k] * offset[k];
    }
    const double reach = (place[2] + error_) * (1 + 0x1p-40) + error_;
    return place[2] > -error_ && std::max(std::fabs(place[0]), std::fabs(place[1])) <= reach;
  }

 private:
  const simd::ShadowFrame& frame_;
  const AskedPoints& points_;
  DVector from_origin_;
  double error_;
};

}  // namespace

std::size_t CellScratch::memory_bytes() const noexcept {
  return sizeof(*this) + bytes_of(points) + bytes_of(dark) + bytes_of(open) + bytes_of(cells) + bytes_of(depths);
}

CellSorter::CellSorter(const simd::ShadowFrame& frame, const LightBounds* bounds)
    : frame_(frame), bounds_(bounds), no_bounds_(bounds == nullptr ? kOddCell : 0, kOpen) {
  texels_ = bounds != nullptr ? bounds->texels() : simd::TexelBounds{no_bounds_.data(), kCellsASide, 0, 0};
}

std::size_t CellSorter::find_cells(const PointQuestion& question, std::size_t first, std::size_t last,
                                   CellScratch& scratch, std::uint16_t* numbers, std::uint16_t* cells) const {
  AskedPoints& points = scratch.points;
  put_points(question.faces, question.targets, first, last, points);
  const std::size_t count = last - first;
  std::uint8_t* const visible = question.visible.data() + first;
  std::fill_n(visible, count, std::uint8_t{1});
  scratch.dark.resize(kPiece + kPadding);
  for (auto* room : {&scratch.open, &scratch.cells, &scratch.depths}) room->resize(kPiece + kPadding);

  const PointProjection projection(points, question.origin, size_of_offsets(points, question.origin));
  const auto from = projection.onto(frame_, simd::kShadowGreatestSlack, visible, 1);
  const simd::OpenPlaces places{kCellsASide, scratch.cells.data(), scratch.depths.data()};
  const std::size_t open =
      simd::decide_points(from, texels_, 0, count, scratch.dark.data(), scratch.open.data(), places).open;
  std::size_t found = 0;
  const auto add = [&](std::uint32_t point, std::size_t cell) {
    numbers[found] = static_cast<std::uint16_t>(point);
    cells[found++] = static_cast<std::uint16_t>(cell);
  };
  const Behind behind(frame_, points, projection);
  for (std::size_t k = 0; k < open; ++k) {
    const bool is_placed = scratch.cells[k] != simd::OpenPlaces::kNone;
    if (is_placed || behind.may_be(scratch.open[k])) add(scratch.open[k], is_placed ? scratch.cells[k] : kOddCell);
  }
  if (bounds_ == nullptr) return found;
  for (std::size_t i = 0; i < count; ++i) visible[i] = scratch.dark[i] == 0;
  for (std::uint32_t i = 0; !question.targets.faces.empty() && i < count; ++i) {
    if (i + kAhead < count && visible[i + kAhead] == 0) prefetch_own(question, points, i + kAhead);
    if (visible[i] != 0 || !may_be_dark_by_own(question, points, i)) continue;
    visible[i] = 1;
    add(i, kOddCell);
  }
  return found;
}

}  // namespace facemap
