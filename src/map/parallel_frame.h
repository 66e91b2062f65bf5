#pragma once

#include <facemap/scene.h>
#include <facemap/space_vector.h>

#include <cstdint>

namespace facemap {

/// Where things lie as seen along a direction d, and the raster over them: x to the right, y up, z along d, in world
/// units about an origin O in the scene's midst. docs/algorithm.md 2.7, "The map", derives the errors.
class ParallelFrame {
 public:
  /// `texels`: about so many a side. Throws Error if the direction is zero or not finite.
  ParallelFrame(const Scene& scene, const Vector& direction, int texels);

  /// In coordinates that are right: an exact frame, orthonormal and with z along d, has the point at most `error` from
  /// here in x, y and z each.
  struct Place {
    DVector at;
    double error;
  };

  /// How far the place of P may be off, relative to |P - O|, if P - O is right to 2^-53, and if it is to
  /// kDirectionError.
  static constexpr double kSharpError = 0x1p-48, kPlaceError = 0x1p-39;

  Place place(const DVector& offset, double relative_error) const;

  /// A difference of two points.
  DVector local(const DVector& difference) const { return axes_.local_from_world(difference); }

  /// O, a float32 point.
  const Vector& origin() const { return axes_.position(); }

  int width() const { return width_; }
  int height() const { return height_; }

  /// A side of a texel, world units.
  double texel() const { return texel_; }

  /// Texels: how far off map points of corners and of points in texels may be.
  double margin() const { return margin_; }

  /// In texels from the raster's upper left corner, y downwards.
  MapPoint map_point(const DVector& at) const;

  enum class Where {
    Nowhere,   ///< no face is met by the line through the point along d
    Texel,     ///< the faces that it meets are in the texel's list
    Anywhere,  ///< the point is too far off to tell
  };
  struct Found {
    Where where = Where::Nowhere;
    std::uint32_t texel = 0;  ///< row * width + column
  };
  Found find(const Place& place) const;

  /// Map units a world unit: a power of two, so that no vertex is 2 units from O.
  double scale() const { return scale_; }

  /// World units: no coordinate of a place in a texel is larger, its z cut to front()..back().
  double extent() const { return extent_; }

  /// World units: places in texels are no farther off than this.
  double allowed_error() const { return allowed_; }

  /// Map units behind a plane well in front of all faces: not negative for a face, 1/8 at least.
  double depth(double z) const { return (z - front_) * scale_; }

  /// z of all faces lies between these two, and not near them.
  double front() const { return front_; }
  double back() const { return back_; }

 private:
  SpaceVector axes_;
  double reach_;  // bound of |P - O| over the vertices of kept faces
  double scale_, extent_ = 0, front_ = 0, back_ = 0, left_ = 0, top_ = 0, texel_ = 1, margin_ = 0, allowed_ = 0;
  int width_ = 1, height_ = 1;
};

}  // namespace facemap
