#pragma once

#include <facemap/scene.h>

#include <cstdint>
#include <span>
#include <vector>

#include "math/exact_sign.h"
#include "simd/hub_boxes.h"
#include "simd/hub_planes.h"
#include "visibility/face_packs.h"

namespace facemap {

/// Points that hubs are asked about, in the units of FacePacks; with room for sixteen more.
struct ScaledPoints {
  std::vector<float> x, y, z;
  std::vector<std::uint32_t> own;  ///< FacePacks::place_of the face that never hides the point, or kNoPlace
  std::span<const Vector> given;   ///< the same in world units
};

/// A face that hides a point, by its place in FacePacks.
struct Blocker {
  std::uint32_t point;
  std::uint32_t place;
};

/// Holds the faces of a scene against the segments from one hub to many points, packs from front to back, until each
/// point has a face that hides it or has passed all packs in its way. Memory is kept from one hub to the next. One a
/// thread.
class HubPass {
 public:
  /// Working memory for `count` points.
  static std::size_t bytes_for(std::size_t count);

  /// Replaces `blockers` by one face for each of `asked` that some face hides from `hub`.
  void run(const Scene& scene, const FacePacks& packs, const Vector& hub, const ScaledPoints& points,
           std::span<const std::uint32_t> asked, std::vector<Blocker>& blockers);

 private:
  struct Open {
    std::uint32_t place;  ///< of a segment
    std::uint32_t pack;
    std::uint16_t faces;
  };

  void sort(const ScaledPoints& points, std::span<const std::uint32_t> asked);
  void count_texels();
  void order_bundles(const FacePacks& packs);
  void set_up(const Scene& scene, const FacePacks& packs, std::size_t pack);
  void ask(std::uint32_t pack, std::size_t candidates, std::vector<Blocker>& blockers);
  void resolve(const Scene& scene, const FacePacks& packs, const ScaledPoints& points, std::vector<Blocker>& blockers);
  void ask_singly(const Scene& scene, const FacePacks& packs, const ScaledPoints& points,
                  std::vector<Blocker>& blockers);

  simd::HubTargets sorted() { return {x_.data(), y_.data(), z_.data(), w_.data()}; }
  simd::HubRaster raster() const { return {texels_, begins_.data(), counts_.data()}; }

  Vector origin_{0};  // in world units
  Vector hub_{0};     // in those of the packs
  int texels_ = 0;
  std::vector<float> x_, y_, z_, w_;
  std::vector<float> from_[3], aimed_[4];
  std::vector<std::uint32_t> texel_of_;
  std::vector<std::uint32_t> numbers_, own_;  // of sorted segments
  std::vector<std::uint32_t> begins_, counts_;
  std::vector<std::uint32_t> near_;  // points almost at the hub
  std::vector<std::uint32_t> candidates_;
  std::vector<simd::HubVerdict> verdicts_;
  std::vector<Open> open_;
  struct Distance {
    float squared;
    std::uint32_t bundle;
  };
  std::vector<Distance> order_;
  simd::HubPlanes planes_;
};

}  // namespace facemap
