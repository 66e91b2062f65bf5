#include "picture/lens_tiles.h"

#include <algorithm>

namespace facemap {
namespace {

// A float32 direction is off from unit length by less.
constexpr double kUnitError = 0x1p-22;

// Where the next border of pieces lies, in samples of the grid that begins at `first` of the picture.
int end_of_piece(int at, int first, int piece, int end) {
  return std::min(end, ((first + at) / piece + 1) * piece - first);
}

// Bits of the two numbers in turn: near tiles of a square get near numbers (Morton 1966).
std::uint64_t interleaved(std::uint32_t x, std::uint32_t y) {
  std::uint64_t z = 0;
  for (int bit = 0; bit < 16; ++bit) {
    z |= std::uint64_t{(x >> bit) & 1} << (2 * bit) | std::uint64_t{(y >> bit) & 1} << (2 * bit + 1);
  }
  return z;
}

// Squares of one piece, so that four in a row tend to lie in a square.
void cut_piece(const TileArea& piece, std::vector<TileArea>& squares) {
  constexpr int kSide = TilePlane::kLargestTile;
  const int across = (piece.columns + kSide - 1) / kSide, down = (piece.rows + kSide - 1) / kSide;
  std::vector<std::pair<std::uint64_t, TileArea>> numbered;
  for (int y = 0; y < down; ++y) {
    for (int x = 0; x < across; ++x) {
      const TileArea square = {piece.first_column + x * kSide, piece.first_row + y * kSide,
                               std::min(kSide, piece.columns - x * kSide), std::min(kSide, piece.rows - y * kSide)};
      numbered.emplace_back(interleaved(static_cast<std::uint32_t>(x), static_cast<std::uint32_t>(y)), square);
    }
  }
  std::sort(numbered.begin(), numbered.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  for (const auto& [number, square] : numbered) squares.push_back(square);
}

std::vector<TileArea> cut(const SampleGrid& grid) {
  const int piece_columns = grid.lens.piece_width() * grid.per_side;
  const int piece_rows = grid.lens.piece_height() * grid.per_side;
  std::vector<TileArea> squares;
  for (int y = 0, below; y < grid.rows(); y = below) {
    below = end_of_piece(y, grid.first_row, piece_rows, grid.rows());
    for (int x = 0, right; x < grid.columns(); x = right) {
      right = end_of_piece(x, grid.first_column, piece_columns, grid.columns());
      cut_piece({x, y, right - x, below - y}, squares);
    }
  }
  return squares;
}

// Calls visit(direction) for each sample of the area that has one.
template <class Visit>
void for_each_direction(const SampleGrid& grid, const TileArea& area, const Visit& visit) {
  const DirectionTable& table = *grid.directions;
  for (int row = 0; row < area.rows; ++row) {
    const std::size_t first =
        static_cast<std::size_t>(area.first_row + row) * static_cast<std::size_t>(grid.columns()) +
        static_cast<std::size_t>(area.first_column);
    for (std::size_t i = first; i < first + static_cast<std::size_t>(area.columns); ++i) {
      const DVector d(table.x[i], table.y[i], table.z[i]);
      if (d != DVector(0)) visit(d);
    }
  }
}

LensTiles::Tile tile_of(const SampleGrid& grid, const TileArea& area) {
  LensTiles::Tile tile{area, {}};
  DVector sum(0);
  int count = 0;
  for_each_direction(grid, area, [&](const DVector& d) {
    sum += d;
    ++count;
  });
  tile.is_empty = count == 0;
  tile.is_whole = count == area.columns * area.rows;
  if (!(length(sum) > 0.1 * count)) return tile;
  const DVector centre = normalized(sum);
  double squared = 0;
  for_each_direction(grid, area, [&](const DVector& d) {
    const DVector chord = d - centre;
    squared = std::max(squared, dot(chord, chord));
  });
  tile.cap = {centre, angle_of_chord(std::sqrt(squared) + kUnitError)};
  return tile;
}

// Divides the area until its tiles are small on the sphere.
void add_tiles(const SampleGrid& grid, const TileArea& area, std::vector<LensTiles::Tile>& tiles) {
  const LensTiles::Tile tile = tile_of(grid, area);
  const bool is_one = area.columns == 1 && area.rows == 1;
  if (tile.is_empty || is_one || tile.cap.radius <= LensTiles::kLargestRadius) {
    tiles.push_back(tile);
    return;
  }
  TileArea first = area, second = area;
  if (area.columns >= area.rows) {
    first.columns = area.columns / 2;
    second.columns -= first.columns;
    second.first_column += first.columns;
  } else {
    first.rows = area.rows / 2;
    second.rows -= first.rows;
    second.first_row += first.rows;
  }
  add_tiles(grid, first, tiles);
  add_tiles(grid, second, tiles);
}

// A cap that holds all of some caps.
template <class Node>
DirectionCap cap_over(const Node* nodes, std::uint32_t count) {
  DVector sum(0);
  for (std::uint32_t i = 0; i < count; ++i) sum += nodes[i].cap.centre;
  if (!(length(sum) > 0.1)) return {};
  const DVector centre = normalized(sum);
  double radius = 0;
  for (std::uint32_t i = 0; i < count; ++i) {
    const double away = angle_of_chord(length(nodes[i].cap.centre - centre)) + DirectionCap::kSlack;
    radius = std::max(radius, away + nodes[i].cap.radius);
  }
  return {centre, std::min(radius, elementary::kPi)};
}

}  // namespace

LensTiles::LensTiles(const SampleGrid& grid, const Executor& executor) {
  find_tiles(grid, executor);
  grow_tree();
}

void LensTiles::find_tiles(const SampleGrid& grid, const Executor& executor) {
  const std::vector<TileArea> squares = cut(grid);
  std::vector<std::vector<Tile>> found(squares.size());
  executor.for_each(squares.size(), [&](std::size_t i, int) { add_tiles(grid, squares[i], found[i]); });
  for (const std::vector<Tile>& tiles : found) tiles_.insert(tiles_.end(), tiles.begin(), tiles.end());
}

// Four nodes in a row get one above them, and so on.
void LensTiles::grow_tree() {
  std::vector<std::vector<Node>> levels(1);
  for (std::size_t i = 0; i < tiles_.size(); ++i) {
    if (!tiles_[i].is_empty) levels[0].push_back({tiles_[i].cap, static_cast<std::uint32_t>(i), 0});
  }
  while (levels.back().size() > 1) {
    const std::vector<Node>& below = levels.back();
    std::vector<Node> above;
    for (std::uint32_t i = 0; i < below.size(); i += kChildren) {
      const std::uint32_t count = std::min(kChildren, static_cast<std::uint32_t>(below.size()) - i);
      above.push_back({cap_over(&below[i], count), i, count});
    }
    levels.push_back(std::move(above));
  }
  std::uint32_t next = 0;  // where the level below begins
  for (std::size_t k = levels.size(); k-- > 0;) {
    next += static_cast<std::uint32_t>(levels[k].size());
    for (Node& node : levels[k]) {
      if (node.children > 0) node.first += next;
      nodes_.push_back(node);
    }
  }
}

}  // namespace facemap
