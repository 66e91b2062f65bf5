// Which points are visible from a point: FaceMap beside Embree, in one process, turn by turn.
//
//   facemap-visibility-bench                       a million random points on the chessboard's faces, 1 and 2 threads
//   facemap-visibility-bench --points 10000 --threads 1 --repeat 15 --scene grass
//   facemap-visibility-bench --many                1,000 origins and 10,000 points of the grass
//
// A point that is rounded to float32 may lie behind its own face, which then hides it: Embree's rays end short of that,
// FaceMap is told in the row of own faces.
//
// Vertices, indices and points are in memory before the clock starts, and the tables of facemap::Scene. Speed is
// Embree's median time over ours; Embree is used in the way that is fastest for the points.

#include <cstdio>
#include <exception>

#include "visibility_many.h"
#include "visibility_one_origin.h"
#include "visibility_options.h"

using namespace facemap::bench;

int main(int argc, char** argv) {
  try {
    const VisibilitySettings settings = read_visibility_settings(argc, argv);
    if (settings.many) {
      measure_many_origins(settings);
    } else {
      measure_one_origin(settings);
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "facemap-visibility-bench: %s\n", error.what());
    return 1;
  }
}
