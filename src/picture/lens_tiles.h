#pragma once

#include <cstdint>
#include <vector>

#include "parallel/executor.h"
#include "picture/direction_cap.h"
#include "picture/sample_grid.h"
#include "picture/tile_raster.h"

namespace facemap {

/// The samples of any lens's grid in tiles that are small on the sphere, and a tree of caps (world axes) over them.
/// Caps are made from the float32 directions themselves: nothing is asked of the lens but where its pieces end.
class LensTiles {
 public:
  /// `grid` must have its directions.
  LensTiles(const SampleGrid& grid, const Executor& executor);

  struct Tile {
    TileArea area;
    DirectionCap cap;
    bool is_whole = true;   ///< all its samples have directions
    bool is_empty = false;  ///< none has
  };
  const std::vector<Tile>& tiles() const { return tiles_; }

  /// Calls visit(tile) for each tile that is not empty if its cap, and all caps above it, pass `may_meet`.
  template <class MayMeet, class Visit>
  void descend(const MayMeet& may_meet, const Visit& visit) const {
    std::uint32_t waiting[kMostWaiting];
    int count = 0;
    if (!nodes_.empty() && may_meet(nodes_[0].cap)) waiting[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[waiting[--count]];
      if (node.children == 0) {
        visit(node.first);
        continue;
      }
      for (std::uint32_t i = node.first; i < node.first + node.children; ++i) {
        if (may_meet(nodes_[i].cap)) waiting[count++] = i;
      }
    }
  }

  /// Tiles reach this far from their middle (radians), unless they have one sample.
  static constexpr double kLargestRadius = 0.2;

 private:
  struct Node {
    DirectionCap cap;
    std::uint32_t first = 0;     // child, or tile
    std::uint32_t children = 0;  // in a row; none: a leaf
  };

  static constexpr std::uint32_t kChildren = 4;
  static constexpr int kMostWaiting = 64;  // 3 siblings on each of 16 levels, and more than 2^31 tiles have those

  void find_tiles(const SampleGrid& grid, const Executor& executor);
  void grow_tree();

  std::vector<Tile> tiles_;
  std::vector<Node> nodes_;  // the root first
};

}  // namespace facemap
