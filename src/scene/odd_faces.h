#pragma once

#include <facemap/mesh.h>
#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "parallel/executor.h"

namespace facemap {

/// For each position, the index of the first position of the same value; -0 is 0. Empty if no two are the same.
std::vector<std::uint32_t> weld(const std::vector<Vector>& positions, const Executor& executor);

/// Counts the odd faces of a mesh and gives one byte a face: 1 if it is kept, 0 if it is odd. A face that is odd
/// in two ways counts once: as repeated_vertex before zero_area before duplicate. `welded` is weld(mesh.positions).
/// Time and memory are linear but for inputs made to be slow, which cost n log n time.
OddFaces find_odd_faces(const Mesh& mesh, const std::vector<std::uint32_t>& welded, const Executor& executor,
                        std::vector<std::uint8_t>& kept);

}  // namespace facemap
