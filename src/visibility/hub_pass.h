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

/// Ends of the segments that begin at hubs, in the units of FacePacks.
struct ScaledPoints {
  std::vector<float> x, y, z;
  std::vector<std::uint32_t> own;  ///< FacePacks::place_of the face that never hides the end, or kNoPlace
  std::vector<Vector> given;       ///< the same in world units
};

/// A face that hides an end from a hub, by its place in FacePacks.
struct Blocker {
  std::uint32_t end;
  std::uint32_t place;
};

/// Holds the faces of a scene against the segments from one hub to many ends, packs from front to back, until each
/// end has a face that hides it or has passed all packs in its way. Memory is kept from one hub to the next. One a
/// thread.
class HubPass {
 public:
  /// Working memory for `count` ends.
  static std::size_t bytes_for(std::size_t count);

  /// Replaces `blockers` by one face for each of `ends` that some face hides from `hub`. `own`: as ScaledPoints::own,
  /// of the hub.
  void run(const Scene& scene, const FacePacks& packs, const Vector& hub, std::uint32_t own, const ScaledPoints& ends,
           std::vector<Blocker>& blockers);

  /// About how much the last run has been: nanoseconds, as it would be on some machine.
  double work() const noexcept { return work_; }

 private:
  struct Distance {
    float squared;
    std::uint32_t bundle;

    friend bool operator<(const Distance& a, const Distance& b) {
      return a.squared != b.squared ? a.squared < b.squared : a.bundle < b.bundle;
    }
  };
  struct Open {
    std::uint32_t place;  ///< of a segment
    std::uint32_t pack;
    std::uint16_t faces;
  };

  void aim(const ScaledPoints& ends, std::uint32_t own);
  void sort();
  void count_texels();
  void drop_blocked();
  void order_bundles(const FacePacks& packs, const Distance& after);
  void ask(std::uint32_t pack, std::size_t candidates, std::vector<Blocker>& blockers);
  void resolve(const Scene& scene, const FacePacks& packs, const ScaledPoints& ends, std::vector<Blocker>& blockers);
  void ask_singly(const Scene& scene, const FacePacks& packs, std::uint32_t own, const ScaledPoints& ends,
                  std::vector<Blocker>& blockers);

  simd::HubTargets as_they_come() { return {aimed_[0].data(), aimed_[1].data(), aimed_[2].data(), aimed_[3].data()}; }
  simd::HubTargets sorted() { return {x_.data(), y_.data(), z_.data(), w_.data()}; }
  simd::HubRaster raster() const { return {texels_, begins_.data(), counts_.data()}; }

  Vector origin_{0};  // in world units
  Vector hub_{0};     // in those of the packs
  int texels_ = 0;
  std::size_t count_ = 0;  // of segments
  double work_ = 0;
  // As they are sorted, then as they come.
  std::vector<float> x_, y_, z_, w_;
  std::vector<std::uint32_t> numbers_, own_;
  std::vector<float> aimed_[4];
  std::vector<std::uint32_t> numbers_from_, own_from_, texel_of_;
  std::vector<std::uint32_t> begins_, counts_;
  std::vector<std::uint32_t> near_;  // ends almost at the hub
  std::vector<std::uint32_t> candidates_;
  std::vector<simd::HubVerdict> verdicts_;
  std::vector<Open> open_;
  std::vector<Distance> order_;
  simd::HubPlanes planes_;
};

}  // namespace facemap
