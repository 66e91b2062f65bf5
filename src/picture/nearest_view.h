#pragma once

#include <facemap/scene.h>

#include <optional>

#include "picture/sample_grid.h"
#include "simd/nearest_boxes.h"
#include "simd/nearest_planes.h"
#include "simd/nearest_vertices.h"

namespace facemap {

/// A plane projection as the raster's kernels see it: samples are points of a plane, at (first_u + column,
/// first_v + row), up to the frame's shift.
struct PlaneView {
  simd::VertexFrame vertices;
  simd::BoxRules boxes;
  simd::PlaneFrame planes;
  double first_u = 0, first_v = 0;
};

/// A power of two that brings lengths up to `largest` to about 1.
double unit_for(double largest);

/// None if rays lie too far from their samples' centres, or fields are too wide, for the bounds to be of use.
std::optional<PlaneView> plane_view(const Scene& scene, const SampleGrid& grid);

}  // namespace facemap
