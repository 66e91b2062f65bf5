#pragma once

#include <facemap/parallel_map.h>
#include <facemap/point_light.h>
#include <facemap/surface_point.h>

#include <optional>

namespace facemap {

/// The ParallelMap of a directional light: answers whether a point is lit by parallel light along its direction, as a
/// PointLight does for a light with a place. It is the limit of a light farther and farther off: each answer is that of
/// any light far enough up the line (docs/algorithm.md, 2.7). All answers are exact.
class ParallelLight : public ParallelMap {
 public:
  using ParallelMap::ParallelMap;
  using On = PointLight::On;

  /// Whether nothing stands strictly between a float32 point and where the light comes from. No facing test; a point on
  /// a face's plane is not blocked by that face, and a face that the light sees edge-on blocks nothing. Throws Error as
  /// PointLight does.
  bool get_lighten_up(const Vector& point, Counters* counters = nullptr) const {
    return get_lighten_up(point, On(), counters);
  }
  bool get_lighten_up(const Vector& point, const On& on, Counters* counters = nullptr) const;

  /// The same for many points: lit[i] becomes 1 if points[i] is lit and 0 if not. Throws Error if the spans differ in
  /// size or a point is not finite; lit is then partly written.
  void get_lighten_up(std::span<const Vector> points, std::span<std::uint8_t> lit, Counters* counters = nullptr) const;

  /// Whether the true point that a camera sees is lit: the light falls strictly on the side of its face that the camera
  /// sees, and nothing is strictly between. Throws Error if the face is not one of the scene, and as is_blocked does.
  bool get_lighten_up(const SurfacePoint& point, Counters* counters = nullptr) const;

  /// The second half alone. Throws Error if the ray lies along the plane of its face or is not finite: there is no
  /// point.
  bool is_blocked(const SurfacePoint& point, Counters* counters = nullptr) const;

  /// The same for a float32 point: face `skip` is passed over if it is not kNoFace, wherever the point lies, and so are
  /// faces from whose plane it is no farther than `tolerance` (world units). Throws Error if the point or the tolerance
  /// is not finite, or the tolerance is below 0. No bounds check of the face.
  bool is_blocked(const Vector& point, FaceId skip, float tolerance = 0, Counters* counters = nullptr) const;

  /// The same for every point within `error` (world units) of `point` in each coordinate at once, face `skip` passed
  /// over if it is not kNoFace: quick, and without an answer where they may differ, or where a hole may matter.
  std::optional<bool> is_blocked_around(const DVector& point, double error, FaceId skip,
                                        Counters* counters = nullptr) const;

 private:
  struct Asked;
  template <class IsThere, class BlocksExactly>
  bool walk(const Parts& of_faces, const Scene& all, const Asked& asked, Counters* counters, const IsThere& is_there,
            const BlocksExactly& blocks_exactly) const;

  // Of all faces; `place` is the point in double.
  template <class Point>
  bool is_blocked(const Point& point, const DVector& place, std::uint32_t skip, Counters* counters) const;
};

}  // namespace facemap
