#include "visibility/pairs.h"

#include <algorithm>
#include <numeric>

namespace facemap {
namespace {

// Vectors of the kernels may read this many elements past what they use.
constexpr std::size_t kPadding = 16;

// Points asked about together: no fewer, whatever the budget, as all faces are gone through for each piece; no more
// than numbers have room for.
constexpr std::size_t kFewestPoints = 1024, kMostPoints = std::size_t{1} << 24;

// Of a point, in a piece.
constexpr std::size_t kPointBytes = 5 * sizeof(std::uint32_t);

// How many points make a piece: a whole number of bytes of a row.
std::size_t piece_for(std::size_t points, std::size_t fixed_bytes, std::size_t memory, std::size_t workers) {
  std::size_t piece = std::min(points, kMostPoints);
  const auto bytes = [&](std::size_t count) { return count * kPointBytes + workers * HubPass::bytes_for(count); };
  if (memory != 0) {
    const std::size_t left = memory - std::min(memory, fixed_bytes);
    while (piece > kFewestPoints && bytes(piece) > left) piece /= 2;
    piece = std::max(piece, std::min(points, kFewestPoints));
  }
  return (piece + 7) / 8 * 8;
}

struct Box {
  Vector lower, upper;
};

Box box_of(std::span<const Vector> origins, std::span<const Vector> points) {
  Box box{origins[0], origins[0]};
  for (const auto& some : {origins, points}) {
    for (const Vector& p : some) {
      for (int k = 0; k < 3; ++k) {
        box.lower[k] = std::min(box.lower[k], p[k]);
        box.upper[k] = std::max(box.upper[k], p[k]);
      }
    }
  }
  return box;
}

FacePacks packs_for(const Scene& scene, std::span<const Vector> origins, std::span<const Vector> points,
                    const Executor& executor) {
  const Box box = box_of(origins, points);
  return FacePacks(scene, box.lower, box.upper, executor);
}

}  // namespace

Pairs::Pairs(const Scene& scene, std::span<const Vector> origins, const Viewpoint::Targets& targets,
             const Executor& executor)
    : scene_(scene),
      origins_(origins),
      targets_(targets),
      executor_(executor),
      packs_(packs_for(scene, origins, targets.points, executor)),
      passes_(static_cast<std::size_t>(executor.threads())),
      blockers_(passes_.size()) {}

void Pairs::run(std::span<std::uint8_t> bits, std::size_t memory, const std::function<void(std::size_t)>& report) {
  const std::size_t count = targets_.points.size();
  const std::size_t piece = piece_for(count, FacePacks::bytes_for(scene_), memory, passes_.size());
  for (std::size_t first = 0; first < count; first += piece) {
    run_piece(first, std::min(first + piece, count), bits, report);
  }
}

void Pairs::run_piece(std::size_t first, std::size_t last, std::span<std::uint8_t> bits,
                      const std::function<void(std::size_t)>& report) {
  set_points(first, last);
  const std::size_t row = visibility_row_bytes(targets_.points.size()), count = last - first;
  executor_.for_each(origins_.size(), [&](std::size_t origin, int worker) {
    const auto w = static_cast<std::size_t>(worker);
    ask_origin(origin, w);
    std::uint8_t* const out = bits.data() + origin * row + first / 8;
    std::fill_n(out, count / 8, std::uint8_t{0xff});
    if (count % 8 != 0) out[count / 8] = static_cast<std::uint8_t>((1u << (count % 8)) - 1);
    for (const Blocker& blocker : blockers_[w]) {
      std::uint8_t& byte = out[blocker.point / 8];
      byte = static_cast<std::uint8_t>(byte & ~(1u << (blocker.point % 8)));
    }
    report(count);
  });
}

void Pairs::set_points(std::size_t first, std::size_t last) {
  const std::size_t count = last - first;
  for (auto* coordinates : {&points_.x, &points_.y, &points_.z}) coordinates->assign(count + kPadding, 0);
  points_.own.assign(count + kPadding, FacePacks::kNoPlace);
  for (std::size_t i = 0; i < count; ++i) {
    const Vector p = packs_.scaled(targets_.points[first + i]);
    points_.x[i] = p.x;
    points_.y[i] = p.y;
    points_.z[i] = p.z;
    const FaceId own = targets_.faces.empty() ? kNoFace : targets_.faces[first + i];
    if (own != kNoFace) points_.own[i] = packs_.place_of(static_cast<std::size_t>(own));
  }
  points_.given = targets_.points.subspan(first, count);
  all_.resize(count);
  std::iota(all_.begin(), all_.end(), 0u);
}

void Pairs::ask_origin(std::size_t origin, std::size_t worker) {
  passes_[worker].run(scene_, packs_, origins_[origin], points_, all_, blockers_[worker]);
}

}  // namespace facemap
