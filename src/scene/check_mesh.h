#pragma once

#include <facemap/mesh.h>

#include <cstddef>

#include "parallel/executor.h"

namespace facemap {

/// Throws Error if a position is not finite, an index or a number of a material is out of range, an array has a wrong
/// size or no face is given.
void check_mesh(const Mesh& mesh, std::size_t material_count, const Executor& executor);

}  // namespace facemap
