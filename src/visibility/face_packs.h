#pragma once

#include <facemap/scene.h>

#include <array>
#include <cstdint>
#include <vector>

#include "parallel/executor.h"
#include "simd/hub_boxes.h"
#include "simd/hub_planes.h"

namespace facemap {

/// The kept faces of a scene in packs of sixteen neighbours, sixteen neighbouring packs a bundle, with their boxes.
/// Everything is in units in which the scene and all points that are asked about lie within [-1, 1] of their middle, a
/// power of two of the world's: differences stay within [-2, 2].
class FacePacks {
 public:
  /// `lower`, `upper`: a box of all points that are asked about.
  FacePacks(const Scene& scene, const Vector& lower, const Vector& upper, const Executor& executor);

  /// Units a world unit.
  double scale() const noexcept { return scale_; }
  Vector scaled(const Vector& p) const { return Vector(DVector(p) * scale_); }

  std::size_t size() const noexcept { return packs_.size(); }
  const simd::FacePack& pack(std::size_t i) const { return packs_[i]; }
  /// Has it fetched before it is needed.
  void prefetch(std::size_t i) const {
    const char* const at = reinterpret_cast<const char*>(&packs_[i]);
    for (std::size_t line = 0; line < sizeof(simd::FacePack); line += 64) __builtin_prefetch(at + line);
  }
  /// How many of its places hold faces.
  std::size_t count(std::size_t i) const { return i + 1 < packs_.size() ? kFaces : last_count_; }

  std::size_t bundles() const noexcept { return boxes_.size(); }
  const simd::PackBoxes& boxes(std::size_t bundle) const { return boxes_[bundle]; }

  /// The boxes of bundles 16 i and on.
  std::size_t bundle_groups() const noexcept { return bundles_.size(); }
  const simd::PackBoxes& bundle_boxes(std::size_t i) const { return bundles_[i]; }

  /// Where a face stands: pack * 16 + place; kNoPlace if it is not kept.
  std::uint32_t place_of(std::size_t face) const { return places_[face]; }
  std::uint32_t face_at(std::uint32_t place) const { return packs_[place / kFaces].ids[place % kFaces]; }
  static constexpr std::uint32_t kNoPlace = 0xffffffffu;

  static std::size_t bytes_for(const Scene& scene);

 private:
  static constexpr std::size_t kFaces = simd::FacePack::kFaces;

  void fill_pack(const Scene& scene, const std::uint32_t* faces, std::size_t pack);
  void set_boxes(std::size_t bundle);

  double scale_ = 1;
  std::size_t last_count_ = kFaces;
  std::vector<simd::FacePack> packs_;
  std::vector<simd::PackBoxes> boxes_;
  std::vector<simd::PackBoxes> bundles_;
  std::vector<std::uint32_t> places_;
};

/// Sets up the planes of a pack about a hub, `hub` in the packs' units and `at` in the world's. Sides that float32
/// leaves open are asked exactly; faces that are seen edge-on block nothing.
void set_up_planes(const Scene& scene, const FacePacks& packs, std::size_t pack, const float* hub, const Vector& at,
                   simd::HubPlanes& planes);

}  // namespace facemap
