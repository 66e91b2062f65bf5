#include "picture/light_bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "picture/face_texels.h"
#include "picture/gnomonic.h"
#include "picture/light_patches.h"
#include "simd/shadow_faces.h"

namespace facemap {
namespace {

constexpr int kLeastSize = 64, kMostSize = 512;  // texels a side

// A raster has about so many texels a face.
constexpr std::size_t kTexelsPerFace = 2;

// Coordinates of vertices on the raster are within this, or the bounds of FaceTexels would not hold.
constexpr float kFarthestPlace = 1.25f;

int size_for(std::size_t faces) {
  int size = kLeastSize;
  while (size < kMostSize && static_cast<std::size_t>(size) * static_cast<std::size_t>(size) < kTexelsPerFace * faces) {
    size *= 2;
  }
  return size;
}

bool is_on_raster(const float* place) {
  return place[2] > 0 && std::fabs(place[0]) <= kFarthestPlace && std::fabs(place[1]) <= kFarthestPlace;
}

}  // namespace

std::optional<LightBounds> LightBounds::find(const Scene& scene, const Vector& light, const std::uint8_t* skip_entries,
                                             const std::vector<FaceNeighbours>& neighbours) {
  if (scene.kept_faces().empty()) return {};
  const Mesh& mesh = scene.mesh();
  DVector lower(HUGE_VAL), upper(-HUGE_VAL);
  for (const std::uint32_t face : scene.kept_faces()) {
    for (int k = 0; k < 3; ++k) {
      const DVector offset = DVector(mesh.vertex(face, k)) - DVector(light);
      for (int axis = 0; axis < 3; ++axis) {
        lower[axis] = std::min(lower[axis], offset[axis]);
        upper[axis] = std::max(upper[axis], offset[axis]);
      }
    }
  }
  const auto frame = frame_towards(light, {lower, upper}, 0);
  if (!frame) return {};
  std::vector<float> places(3 * (mesh.positions.size() + 16));
  simd::project_vertices(*frame, &mesh.positions[0].x, mesh.positions.size(), places.data());

  LightBounds bounds;
  bounds.frame_ = *frame;
  bounds.size_ = size_for(scene.kept_faces().size());
  std::vector<float> lit(static_cast<std::size_t>(bounds.size_) * static_cast<std::size_t>(bounds.size_), 0.0f);
  float least = std::numeric_limits<float>::infinity(), greatest = 0;
  for (const std::uint32_t face : scene.kept_faces()) {
    const float* corners[3];
    for (std::size_t k = 0; k < 3; ++k) {
      corners[k] = places.data() + 3 * std::size_t{mesh.triangles[face][k]};
      if (!is_on_raster(corners[k])) return {};
      least = std::min(least, corners[k][2]);
      greatest = std::max(greatest, corners[k][2]);
    }
    const FaceTexels texels(corners[0], corners[1], corners[2], bounds.size_);
    if (texels.side() < 0 && skip_entries != nullptr && skip_entries[face] != 0) continue;
    texels.for_each(
        [&](const FaceTexels::Piece& piece) { lit[piece.texel] = std::max(lit[piece.texel], piece.greatest); });
  }
  bounds.encode(lit, find_dark(scene, neighbours, places, bounds.size_), least, greatest);
  return bounds;
}

// A number is monotone in w, however it is rounded: of two that differ it is known which w is greater.
void LightBounds::encode(const std::vector<float>& lit, const std::vector<float>& dark, float least, float greatest) {
  w_least_ = least;
  // The last step is for points in front of all faces.
  w_scale_ =
      (simd::TexelBounds::kSteps - 1) / (greatest * (simd::kShadowDepthFactor * simd::kShadowDepthFactor) - least);
  const auto number = [&](float w) { return std::clamp((w - w_least_) * w_scale_, 0.0f, simd::TexelBounds::kSteps); };
  texels_.resize(lit.size());
  for (std::size_t t = 0; t < lit.size(); ++t) {
    const auto upper = lit[t] > 0 ? std::max(static_cast<std::uint32_t>(std::ceil(number(lit[t]))), 1u) : 0u;
    const auto lower = dark[t] > 0 ? static_cast<std::uint32_t>(std::floor(number(dark[t]))) : 0u;
    texels_[t] = upper << 16 | lower;
  }
}

}  // namespace facemap
