#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string_view>
#include <vector>

namespace facemap {

/// What an Image can hold of each pixel besides its colour (AOVs): of the ray through the pixel's centre.
enum class Plane {
  Id,          ///< the face that is seen
  Depth,       ///< distance along the ray
  Z,           ///< distance along the sight
  Position,    ///< of the point that is seen
  Normal,      ///< that of shading
  FaceNormal,  ///< that of the face's plane
  Albedo,      ///< the surface's own colour
  Uv,          ///< texture coordinates
  Object,      ///< the model's object
  Material,    ///< the model's material
  Lights,      ///< which lights reach the point
  Shadows,     ///< how many lights do not
};

/// A set of planes.
class PlaneSet {
 public:
  constexpr PlaneSet() = default;
  constexpr PlaneSet(std::initializer_list<Plane> planes) {
    for (const Plane plane : planes) add(plane);
  }

  constexpr bool has(Plane plane) const { return (bits_ & bit(plane)) != 0; }
  constexpr bool has_any(PlaneSet of) const { return (bits_ & of.bits_) != 0; }
  constexpr bool empty() const { return bits_ == 0; }
  constexpr void add(Plane plane) { bits_ |= bit(plane); }
  constexpr void remove(Plane plane) { bits_ &= ~bit(plane); }
  friend constexpr bool operator==(PlaneSet, PlaneSet) = default;

 private:
  static constexpr std::uint32_t bit(Plane plane) { return std::uint32_t{1} << static_cast<int>(plane); }

  std::uint32_t bits_ = 0;
};

/// All of them, in order.
const std::vector<Plane>& all_planes();

/// "id", "depth", "face-normal" and so on.
const char* name_of(Plane plane);

/// The plane of that name; none if there is no such plane.
std::optional<Plane> plane_named(std::string_view name);

}  // namespace facemap
