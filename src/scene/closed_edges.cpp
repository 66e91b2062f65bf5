#include "scene/closed_edges.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <deque>
#include <iterator>

#include "math/exact_sign.h"
#include "scene/pieces.h"
#include "scene/welded.h"

namespace facemap {

namespace {

constexpr std::size_t kLeastPiece = 1 << 15;  ///< faces worth a task of their own

/// A directed edge: the vertex it leaves in the upper half, the one it enters in the lower. Never 0, as they differ.
using Edge = std::uint64_t;

constexpr Edge kNone = 0;

Edge edge(std::uint32_t from, std::uint32_t to) { return Edge{from} << 32 | to; }
Edge opposite(Edge edge) { return std::rotl(edge, 32); }
Edge undirected(Edge edge) { return std::min(edge, opposite(edge)); }
std::uint32_t start_of(Edge edge) { return static_cast<std::uint32_t>(edge >> 32); }

/// In blocks: a list of unknown length without the moves and the spare room of a vector.
using EdgeList = std::deque<Edge>;

/// Cancels edges against their opposites while they are near each other in the file, as nearly all are: a table holds
/// the edges seen last; what it must give up is taken to the next stage.
template <int kSlotBits, class NextStage>
class EdgeWindow {
 public:
  explicit EdgeWindow(NextStage& next) : next_(next), slots_(std::size_t{1} << kSlotBits, kNone) {}

  void push_back(Edge e) {
    // Other bits of the product for each size: edges that share a slot in one stage seldom do in the next.
    Edge& slot = slots_[undirected(e) * 0x9E3779B97F4A7C15u << kShift >> (64 - kSlotBits)];
    const Edge seen = slot;
    // No branch: which edges meet their opposites is hard to predict.
    const Edge stays = Edge{seen == opposite(e)} - 1;  // all bits or none
    slot = e & stays;
    if ((seen & stays) != kNone) [[unlikely]]
      next_.push_back(seen);
  }

  void flush() {
    for (const Edge e : slots_) {
      if (e != kNone) next_.push_back(e);
    }
  }

 private:
  static constexpr int kShift = kSlotBits;

  NextStage& next_;
  std::vector<Edge> slots_;
};

// 256 kB and 32 kB: what fits into the second and the first level of caches.
using FarWindow = EdgeWindow<15, EdgeList>;
using NearWindow = EdgeWindow<12, FarWindow>;

/// Several threads may set the same one, all to the same value.
void set_kind(SetKind& kind, SetKind value) { std::atomic_ref(kind).store(value, std::memory_order_relaxed); }

/// What a piece of the faces leaves.
struct Remains {
  EdgeList edges;  ///< that have not met their opposites
  std::vector<FaceRun> runs;
};

/// Goes through a piece of the faces; marks the sets that have a kept face as closed so far.
Remains cancel_nearby(const Scene& scene, const VertexSets& sets, std::size_t begin, std::size_t end,
                      std::vector<SetKind>& kinds) {
  Remains remains;
  FarWindow far(remains.edges);
  NearWindow near(far);
  std::uint32_t root_before = kNoIndex;
  // The edge back to a face's first corner: in a polygon's fan of faces the next one begins with its opposite.
  Edge last = kNone;
  for (std::size_t face = begin; face != end; ++face) {
    const Corners c = welded_corners(scene.mesh().triangles[face], scene.welded());
    const std::uint32_t root = sets.root_of(c[0]);
    if (root != root_before) remains.runs.push_back({static_cast<std::uint32_t>(face), root});
    root_before = root;
    if (!has_edges(scene, face, c)) continue;
    if (scene.is_kept(face)) set_kind(kinds[root], SetKind::Closed);
    const Edge first = edge(c[0], c[1]);
    if (first != opposite(last)) {
      if (last != kNone) near.push_back(last);
      near.push_back(first);
    }
    near.push_back(edge(c[1], c[2]));
    last = edge(c[2], c[0]);
  }
  if (last != kNone) near.push_back(last);
  near.flush();
  far.flush();
  return remains;
}

std::uint32_t weight(Edge edge) {
  const std::uint64_t h = undirected(edge) * 0xD6E8FEB86659FD93u;
  return static_cast<std::uint32_t>((h ^ h >> 32) * 0x9E3779B97F4A7C15u >> 32);
}

/// Gives each pair of vertices a weight and sums it over the edges of a set, with the sign of their direction. Where
/// edges cancel the sum is 0; so it proves most open sets open. (A sum of 0 proves nothing.)
void mark_sets_by_sums(const std::vector<Remains>& left, const VertexSets& sets, const Executor& executor,
                       std::vector<SetKind>& kinds) {
  std::vector<std::uint32_t> sums(sets.size(), 0);
  executor.for_each(left.size(), [&](std::size_t piece, int) {
    for (const Edge e : left[piece].edges) {
      const std::uint32_t w = e == undirected(e) ? weight(e) : 0 - weight(e);
      std::uint32_t& sum = sums[sets.root_of(start_of(e))];
      if (left.size() == 1) {
        sum += w;
      } else {
        std::atomic_ref(sum).fetch_add(w, std::memory_order_relaxed);
      }
    }
  });
  for (std::size_t root = 0; root < sums.size(); ++root) {
    if (sums[root] != 0) kinds[root] = SetKind::Open;
  }
}

/// Edges by their direction, each as its undirected form.
struct Directions {
  std::vector<Edge> up, down;
};

/// Marks the sets of edges that are there more often in one direction than in the other.
void mark_sets_by_sorting(Directions& edges, const VertexSets& sets, std::vector<SetKind>& kinds) {
  std::sort(edges.up.begin(), edges.up.end());
  std::sort(edges.down.begin(), edges.down.end());
  std::vector<Edge> unbalanced;
  std::set_symmetric_difference(edges.up.begin(), edges.up.end(), edges.down.begin(), edges.down.end(),
                                std::back_inserter(unbalanced));
  for (const Edge e : unbalanced) {
    set_kind(kinds[sets.root_of(start_of(e))], SetKind::Open);
  }
}

/// Decides the sets that may still be closed, one class of pairs of vertices at a time, which bounds the memory.
void mark_the_rest(const std::vector<Remains>& left, const VertexSets& sets, const Executor& executor,
                   std::vector<SetKind>& kinds) {
  constexpr std::size_t kClassSize = 1 << 16;
  constexpr std::size_t kMostClasses = 16;
  std::size_t count = 0;
  for (const Remains& remains : left) count += remains.edges.size();
  const std::size_t classes = std::clamp<std::size_t>(count / kClassSize, 1, kMostClasses);
  std::vector<SetKind> found = kinds;
  executor.for_each(classes, [&](std::size_t which, int) {
    Directions edges;
    for (const Remains& remains : left) {
      for (const Edge e : remains.edges) {
        if (classes > 1 && weight(e) * std::uint64_t{classes} >> 32 != which) continue;
        if (kinds[sets.root_of(start_of(e))] == SetKind::Open) continue;
        (e == undirected(e) ? edges.up : edges.down).push_back(undirected(e));
      }
    }
    mark_sets_by_sorting(edges, sets, found);
  });
  kinds = std::move(found);
}

}  // namespace

bool fills_a_gap(const Scene& scene, std::size_t face, const Corners& corners) {
  const Mesh& mesh = scene.mesh();
  return !repeats_vertex(corners) && is_degenerate(mesh.vertex(face, 0), mesh.vertex(face, 1), mesh.vertex(face, 2));
}

ClosedSets find_closed_sets(const Scene& scene, const VertexSets& sets, const Executor& executor) {
  ClosedSets found;
  found.kinds.assign(sets.size(), SetKind::NoFaces);
  const Pieces pieces(executor, scene.face_count(), kLeastPiece);
  std::vector<Remains> left(pieces.size());
  executor.for_each(pieces.size(), [&](std::size_t piece, int) {
    left[piece] = cancel_nearby(scene, sets, pieces.begin(piece), pieces.end(piece), found.kinds);
  });
  for (const Remains& remains : left) found.runs.insert(found.runs.end(), remains.runs.begin(), remains.runs.end());
  if (std::any_of(left.begin(), left.end(), [](const Remains& remains) { return !remains.edges.empty(); })) {
    mark_sets_by_sums(left, sets, executor, found.kinds);
    mark_the_rest(left, sets, executor, found.kinds);
  }
  return found;
}

}  // namespace facemap
