#pragma once

#include <cstddef>
#include <cstdint>

namespace facemap::simd {

/// Sixteen faces side by side: coordinate i of corner k, and their ids. Places without a face repeat another's corners.
struct alignas(64) FacePack {
  static constexpr std::size_t kFaces = 16;
  float corners[3][3][kFaces];
  std::uint32_t ids[kFaces];
};

/// Planes of sixteen faces about a hub: the point that many segments share. A segment goes from the hub to hub + D; its
/// direction is D w with w a float32 near 1 / |D|, largest components. Values are divided by the bound of their own
/// error, so that one above 1 is surely positive and one below -1 surely negative:
///   ab . D w, ca . D w and normal . D w - ab . D w - ca . D w, which are all >= 0 where the line meets the face;
///   scale (normal . D w) - height w, which is > 0 where the segment ends beyond the face's plane; the bound of this
///   one is 1 + reach w.
struct alignas(64) HubPlanes {
  float ab[3][FacePack::kFaces];
  float ca[3][FacePack::kFaces];
  float normal[3][FacePack::kFaces];
  float scale[FacePack::kFaces];
  float height[FacePack::kFaces];
  float reach[FacePack::kFaces];
};

/// Returns one bit for each face whose side towards the hub float32 leaves open: its planes are those of a face turned
/// away from the hub. Corners and hub lie in units in which all differences are within [-2, 2].
std::uint32_t set_up_hub_planes(const FacePack& faces, const float* hub, HubPlanes& planes);

/// Says that face `face` is turned towards the hub after all.
void turn_plane(HubPlanes& planes, std::size_t face);

/// Says that face `face` blocks nothing: it is seen edge-on, or is none.
void remove_plane(HubPlanes& planes, std::size_t face);

/// Segments' ends: D w and w of each, with room for sixteen more.
struct HubTargets {
  float* x;
  float* y;
  float* z;
  float* w;
};

/// The least |D| that a segment may have, largest component.
inline constexpr float kLeastHubDistance = 0x1p-60f;

/// w of a segment that is not to be asked about.
inline constexpr float kNoHubTarget = 0x1p120f;

/// Fills `targets` with the segments from `hub` to `count` points. Where one is shorter than kLeastHubDistance, w is
/// kNoHubTarget.
void aim_at(const float* hub, const float* x, const float* y, const float* z, std::size_t count,
            const HubTargets& targets);

/// What sixteen faces say of a segment: one bit a face.
struct HubVerdict {
  std::uint32_t place;
  std::uint16_t yes;   ///< surely blocked by these
  std::uint16_t open;  ///< perhaps by these
};

/// Asks all sixteen faces about each of `count` segments, which `places` names in `targets`. Writes the verdicts that
/// are not all no, and returns how many. `own_places`: of each segment the place of the face that is
/// not asked; the faces are of pack `pack`.
std::size_t ask_pack(const HubPlanes& planes, std::uint32_t pack, const HubTargets& targets,
                     const std::uint32_t* own_places, const std::uint32_t* places, std::size_t count,
                     HubVerdict* verdicts);

}  // namespace facemap::simd
