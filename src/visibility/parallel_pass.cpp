#include "visibility/parallel_pass.h"

#include <algorithm>
#include <cmath>

#include "map/face_planes.h"
#include "map/texels.h"
#include "math/dvector.h"
#include "math/parallel_signs.h"

namespace facemap {
namespace {

// Of the frame, whose raster is not used: so many a side that its margin is small beside a texel.
constexpr int kFrameTexels = 64;

// About a target a cell, and no more cells a side than this.
constexpr double kMostCells = 512;

}  // namespace

/// What a run is about. The frame must be in its place before `faces`, which refers to it.
struct ParallelPass::Question {
  const Vector& d;
  std::size_t first;
  std::span<std::uint8_t> visible;
  const ParallelFrame& frame;
  const ParallelFaces& faces;
};

int ParallelPass::Grid::index(double cells) const { return static_cast<int>(std::clamp(cells, 0.0, side - 1.0)); }

std::size_t ParallelPass::bytes_for(const Scene& scene, std::size_t targets) {
  return scene.mesh().positions.size() * sizeof(Spot) +
         targets * (2 * sizeof(Slot) + sizeof(MapPoint) + 2 * sizeof(Cell));
}

void ParallelPass::run(const Vector& d, std::size_t first, std::span<std::uint8_t> visible) {
  std::fill(visible.begin(), visible.end(), std::uint8_t{1});
  if (scene_.kept_faces().empty()) return;  // nor has the scene a size then
  const ParallelFrame frame(scene_, d, kFrameTexels);
  const ParallelFaces faces(frame);
  const Question question{d, first, visible, frame, faces};
  place_targets(question);
  if (slots_.empty()) return;
  sort_targets(frame);
  place_vertices(frame);
  for (const std::uint32_t face : scene_.kept_faces()) run_face(question, face);
}

GivenPoint ParallelPass::given(std::size_t target) const {
  GivenPoint point{targets_.points[target]};
  point.tolerance = targets_.tolerance;
  return point;
}

bool ParallelPass::is_own(std::uint32_t face, std::size_t target) const {
  return !targets_.faces.empty() && targets_.faces[target] == static_cast<FaceId>(face);
}

// Those so far off that the frame cannot tell where they are.
bool ParallelPass::is_hidden_by_any(const Question& question, std::size_t target) const {
  const auto faces = scene_.kept_faces();
  return std::any_of(faces.begin(), faces.end(), [&](std::uint32_t id) {
    const Triangle face = triangle_of(scene_, id);
    return !is_own(id, target) && blocks_along(face, side_along(face, question.d), question.d, given(target));
  });
}

void ParallelPass::place_targets(const Question& question) {
  const ParallelFrame& frame = question.frame;
  slots_.clear();
  places_.clear();
  for (std::size_t i = 0; i < question.visible.size(); ++i) {
    const std::size_t target = question.first + i;
    const DVector offset = DVector(targets_.points[target]) - DVector(frame.origin());
    const ParallelFrame::Place place = frame.place(offset, ParallelFrame::kSharpError);
    const ParallelFrame::Where where = frame.find(place).where;
    if (where == ParallelFrame::Where::Anywhere) question.visible[i] = !is_hidden_by_any(question, target);
    if (where != ParallelFrame::Where::Texel) continue;
    const double reach = frame.depth(place.at.z + place.error) * (1 + Texels::kDepthMargin);
    slots_.push_back({question.faces.asked(place), float_above(reach), static_cast<std::uint32_t>(i), 0});
    places_.push_back(frame.map_point(place.at));
  }
}

void ParallelPass::sort_targets(const ParallelFrame& frame) {
  MapPoint lower = places_[0], upper = places_[0];
  for (const MapPoint& p : places_) {
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
  }
  const int side = static_cast<int>(std::min(std::ceil(std::sqrt(static_cast<double>(slots_.size()))), kMostCells));
  const MapPoint size = {std::max(upper.x - lower.x, frame.margin()), std::max(upper.y - lower.y, frame.margin())};
  grid_ = {lower, upper, {side / size.x, side / size.y}, side};

  const auto cell_count = static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
  cells_.assign(cell_count, Cell());
  for (std::size_t i = 0; i < slots_.size(); ++i) {
    const int cell = grid_.row(places_[i].y) * side + grid_.column(places_[i].x);
    slots_[i].cell = static_cast<std::uint32_t>(cell);
    Cell& of = cells_[slots_[i].cell];
    ++of.end;
    of.reach = std::max(of.reach, slots_[i].reach);
  }
  std::uint32_t begin = 0;
  for (Cell& cell : cells_) {
    const std::uint32_t count = cell.end;
    cell.begin = cell.end = begin;
    begin += count;
  }
  sorted_.resize(slots_.size());
  for (const Slot& slot : slots_) sorted_[cells_[slot.cell].end++] = slot;
}

void ParallelPass::place_vertices(const ParallelFrame& frame) {
  const std::vector<Vector>& positions = scene_.mesh().positions;
  vertices_.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const DVector at = frame.local(DVector(positions[i]) - DVector(frame.origin()));
    vertices_[i] = {frame.map_point(at), at.z};
  }
}

void ParallelPass::run_face(const Question& question, std::uint32_t face) {
  const auto& corner = scene_.mesh().triangles[face];
  const Spot &a = vertices_[corner[0]], &b = vertices_[corner[1]], &c = vertices_[corner[2]];
  const double margin = question.frame.margin();
  const double x0 = std::min({a.at.x, b.at.x, c.at.x}) - margin, x1 = std::max({a.at.x, b.at.x, c.at.x}) + margin;
  const double y0 = std::min({a.at.y, b.at.y, c.at.y}) - margin, y1 = std::max({a.at.y, b.at.y, c.at.y}) + margin;
  if (x1 < grid_.lower.x || x0 > grid_.upper.x || y1 < grid_.lower.y || y0 > grid_.upper.y) return;
  const float nearest = std::max(0.0f, float_below(question.frame.depth(std::min({a.z, b.z, c.z}))));

  const int first = grid_.column(x0), last = grid_.column(x1), bottom = grid_.row(y1);
  bool is_ready = false;
  int side = 0;
  ParallelFaces::Face filter;
  for (int y = grid_.row(y0); y <= bottom; ++y) {
    Cell* const row = cells_.data() + static_cast<std::ptrdiff_t>(y) * grid_.side;
    for (Cell* cell = row + first; cell <= row + last; ++cell) {
      if (cell->begin == cell->end || nearest > cell->reach) continue;
      if (!is_ready) {
        const Triangle corners = triangle_of(scene_, face);
        side = side_along(corners, question.d);
        if (side == 0) return;
        filter = question.faces.face_of({corners[0], corners[1], corners[2]}, side);
        is_ready = true;
      }
      ask_cell(question, face, filter, side, *cell);
    }
  }
}

// With a tolerance a face that the filter takes for a blocker may be within it.
void ParallelPass::ask_cell(const Question& question, std::uint32_t face, const ParallelFaces::Face& filter, int side,
                            Cell& cell) {
  const std::uint32_t end = cell.end;
  for (std::uint32_t i = cell.end; i-- > cell.begin;) {
    const Slot& slot = sorted_[i];
    const std::size_t target = question.first + slot.target;
    if (filter.nearest > slot.reach || is_own(face, target)) continue;
    const ParallelFaces::Sides sides = ParallelFaces::sides(filter, slot.at);
    if (sides.surely_outside || sides.beyond < 0) continue;
    const bool is_sure = sides.surely_inside && sides.beyond > 0 && !(targets_.tolerance > 0);
    if (!is_sure && !blocks_along(triangle_of(scene_, face), side, question.d, given(target))) continue;
    question.visible[slot.target] = 0;
    std::swap(sorted_[i], sorted_[--cell.end]);
  }
  if (cell.end == end) return;
  cell.reach = 0;
  for (std::uint32_t i = cell.begin; i < cell.end; ++i) cell.reach = std::max(cell.reach, sorted_[i].reach);
}

}  // namespace facemap
