#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "parallel/executor.h"
#include "scene/vertex_sets.h"

namespace facemap {

/// Whether the directed edges of a face count for its part: those of kept faces and of faces without area do, not
/// those of duplicates. `corners` are its welded ones; if they repeat a vertex its edges cancel among themselves.
bool has_edges(const Scene& scene, std::size_t face, const Corners& corners);

/// What is known of the set of vertices below a root.
enum class SetKind : std::uint8_t { NoFaces, Closed, Open };

/// One for each vertex that is a root of `sets`, which hold the connected vertices; NoFaces for the others. A set with
/// a kept face is closed if for each two of its vertices as many directed edges lead from the one to the other as
/// back; for certain.
std::vector<SetKind> find_closed_sets(const Scene& scene, const VertexSets& sets, const Executor& executor);

}  // namespace facemap
