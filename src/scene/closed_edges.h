#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <vector>

#include "parallel/executor.h"
#include "scene/vertex_sets.h"

namespace facemap {

/// Whether a face that is not kept has no area, and is no duplicate. `corners` are its welded ones; false if they
/// repeat a vertex, as then its edges cancel among themselves.
bool fills_a_gap(const Scene& scene, std::size_t face, const Corners& corners);

/// Whether the directed edges of a face count for its part.
inline bool has_edges(const Scene& scene, std::size_t face, const Corners& corners) {
  return scene.is_kept(face) || fills_a_gap(scene, face, corners);
}

/// What is known of the set of vertices below a root.
enum class SetKind : std::uint8_t { NoFaces, Closed, Open };

/// Faces side by side that belong to one set, up to the next run; the set is named by its root.
struct FaceRun {
  std::uint32_t first_face, root;
};

struct ClosedSets {
  std::vector<SetKind> kinds;  ///< one for each vertex that is a root; NoFaces for the others
  std::vector<FaceRun> runs;   ///< of all faces
};

/// `sets` holds the connected vertices. A set with a kept face is closed if for each two of its vertices as many
/// directed edges lead from the one to the other as back; for certain.
ClosedSets find_closed_sets(const Scene& scene, const VertexSets& sets, const Executor& executor);

}  // namespace facemap
