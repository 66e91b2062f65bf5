#include "simd/floating_point_mode.h"
#include "visibility/pieces.h"
#include "visibility/ray_order.h"
#include "visibility/viewpoint_parts.h"

namespace facemap {
namespace {

constexpr std::size_t kPiece = 1024;  // rays

}  // namespace

void Viewpoint::nearest(std::span<const Vector> directions, std::span<FaceId> faces, std::span<float> distances,
                        const Progress& progress) const {
  const FloatingPointMode mode;
  check_size(faces.size(), directions.size());
  check_size(distances.size(), directions.size());
  if (directions.empty()) return;
  const RayLists& lists = kept_->near_lists();
  const RayOrder order(kept_->executor, lists, directions.size(),
                       [&](std::size_t i) { return lists.place_of(DVector(directions[i])); });
  for_pieces(kept_->executor, directions.size(), kPiece, progress,
             [&](std::size_t first, std::size_t last, std::size_t) {
               for (std::size_t k = first; k < last; ++k) {
                 const std::size_t i = order[k];
                 order.prefetch_after(k, directions.data());
                 const Camera::Hit hit = lists.nearest(order.place(k), directions[i]);
                 faces[i] = hit.face;
                 distances[i] = hit.depth;
               }
             });
}

}  // namespace facemap
