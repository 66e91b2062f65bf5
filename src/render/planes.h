#pragma once

#include <facemap/image.h>
#include <facemap/plane.h>
#include <facemap/scene.h>

#include "material/material_table.h"
#include "parallel/executor.h"
#include "picture/sample_grid.h"
#include "render/parallel_eye.h"

namespace facemap {

/// What a picture must be asked for itself, by whichever strategy, so that fill_planes can give `wanted`: faces and
/// lights.
PlaneSet asked_planes(PlaneSet wanted);

/// Whose planes are filled.
struct PlaneSource {
  const Scene& scene;
  const SampleGrid& centres;       ///< of the pixels: one sample each
  bool is_smooth;                  ///< shading takes the file's normals
  const MaterialTable* materials;  ///< null: all is white
  const Executor& executor;
  const ParallelEye* eye = nullptr;  ///< if the picture is orthographic: the grid gives places and axes, and no rays
};

/// Fills the planes that follow from the faces and lights of each pixel's centre, which the image has (asked_planes),
/// and takes away what is not wanted.
void fill_planes(const PlaneSource& source, PlaneSet wanted, Image& image);

}  // namespace facemap
