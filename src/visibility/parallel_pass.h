#pragma once

#include <facemap/scene.h>
#include <facemap/viewpoint.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "map/parallel_faces.h"
#include "map/parallel_frame.h"
#include "math/exact_sign.h"

namespace facemap {

/// Which of some points parallel light reaches, all faces without holes: the points are sorted into a grid across the
/// light and the faces run over it, without a map. Takes memory for one direction at a time, and keeps it.
class ParallelPass {
 public:
  /// Scene and targets must outlive it.
  ParallelPass(const Scene& scene, const Viewpoint::Targets& targets) : scene_(scene), targets_(targets) {}

  /// visible[i] becomes 1 if nothing stands strictly between target first + i and where light along d comes from, and 0
  /// if something does.
  void run(const Vector& d, std::size_t first, std::span<std::uint8_t> visible);

  /// What it takes for so many targets at a time.
  static std::size_t bytes_for(const Scene& scene, std::size_t targets);

 private:
  // A vertex: on the grid's plane, in texels of the frame, and along d.
  struct Spot {
    MapPoint at;
    double z;
  };

  // A target that no face is known to hide; `reach` bounds its depth from above.
  struct Slot {
    ParallelFaces::Asked at;
    float reach;
    std::uint32_t target;
    std::uint32_t cell;
  };

  // The elements of slots_ that are in a cell and not hidden, and the largest of their reaches.
  struct Cell {
    std::uint32_t begin = 0, end = 0;
    float reach = 0;
  };

  // The grid: `lower` and `upper` bound the targets' map points.
  struct Grid {
    MapPoint lower, upper, cells_a_texel;
    int side;

    int column(double x) const { return index((x - lower.x) * cells_a_texel.x); }
    int row(double y) const { return index((y - lower.y) * cells_a_texel.y); }
    int index(double cells) const;
  };

  struct Question;

  void place_vertices(const ParallelFrame& frame);
  void place_targets(const Question& question);
  void sort_targets(const ParallelFrame& frame);
  void run_face(const Question& question, std::uint32_t face);
  void ask_cell(const Question& question, std::uint32_t face, const ParallelFaces::Face& filter, int side, Cell& cell);
  bool is_hidden_by_any(const Question& question, std::size_t target) const;
  GivenPoint given(std::size_t target) const;
  bool is_own(std::uint32_t face, std::size_t target) const;

  const Scene& scene_;
  const Viewpoint::Targets& targets_;
  std::vector<Spot> vertices_;
  std::vector<MapPoint> places_;  // of the slots before they are sorted
  std::vector<Slot> slots_, sorted_;
  std::vector<Cell> cells_;
  Grid grid_{};
};

}  // namespace facemap
