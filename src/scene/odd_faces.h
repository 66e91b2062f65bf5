#pragma once

#include <facemap/mesh.h>
#include <facemap/scene.h>

#include <cstdint>
#include <vector>

namespace facemap {

/// For each item, the index of the first item that equals it (its own if it is the first).
std::vector<std::uint32_t> first_equal(const std::vector<Corners>& items);

/// For each position, the index of the first position of the same value; -0 is 0.
std::vector<std::uint32_t> weld(const std::vector<Vector>& positions);

/// Counts the odd faces of a mesh and gives one byte a face: 1 if it is kept, 0 if it is odd. A face that is odd
/// in two ways counts once: as repeated_vertex before zero_area before duplicate. Time and memory are linear but
/// for inputs made to be slow, which cost n log n time.
OddFaces find_odd_faces(const Mesh& mesh, std::vector<std::uint8_t>& kept);

}  // namespace facemap
