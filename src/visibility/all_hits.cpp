#include <algorithm>
#include <numeric>

#include "simd/floating_point_mode.h"
#include "visibility/pieces.h"
#include "visibility/ray_order.h"
#include "visibility/viewpoint_parts.h"

namespace facemap {
namespace {

constexpr std::size_t kPiece = 1024;  // rays

}  // namespace

// Each piece's hits are collected apart, then joined.
AllHits Viewpoint::all_hits(std::span<const Vector> directions, const Progress& progress) const {
  const FloatingPointMode mode;
  AllHits hits;
  if (directions.empty()) return hits;
  const RayLists& lists = kept_->whole_lists();
  const RayOrder order(kept_->executor, lists, directions.size(),
                       [&](std::size_t i) { return lists.place_of(DVector(directions[i])); });
  hits.begins.resize(directions.size() + 1);
  std::vector<std::vector<Meeting>> pieces((directions.size() + kPiece - 1) / kPiece);
  for_pieces(kept_->executor, directions.size(), kPiece, progress,
             [&](std::size_t first, std::size_t last, std::size_t piece) {
               for (std::size_t k = first; k < last; ++k) {
                 const std::size_t i = order[k];
                 order.prefetch_after(k, directions.data());
                 const std::size_t before = pieces[piece].size();
                 lists.meet_all(order.place(k), directions[i], pieces[piece]);
                 hits.begins[i + 1] = pieces[piece].size() - before;
               }
             });
  std::partial_sum(hits.begins.begin(), hits.begins.end(), hits.begins.begin());
  hits.faces.resize(hits.begins.back());
  hits.distances.resize(hits.begins.back());
  kept_->executor.for_each(pieces.size(), [&](std::size_t piece, int) {
    const Meeting* meeting = pieces[piece].data();
    const std::size_t end = std::min((piece + 1) * kPiece, directions.size());
    for (std::size_t k = piece * kPiece; k < end; ++k) {
      const std::size_t i = order[k];
      for (std::size_t to = hits.begins[i]; to < hits.begins[i + 1]; ++to, ++meeting) {
        hits.faces[to] = meeting->face;
        hits.distances[to] = meeting->distance;
      }
    }
    std::vector<Meeting>().swap(pieces[piece]);
  });
  return hits;
}

}  // namespace facemap
