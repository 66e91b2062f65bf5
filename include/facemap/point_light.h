#pragma once

#include <facemap/color.h>
#include <facemap/face_map.h>
#include <facemap/surface_point.h>

#include <cstdint>

namespace facemap {

/// The FaceMap that keeps the distribution of all faces about a light and answers whether a point is lit.
/// Wang 2022, sec. 4.3: the Point Light class.
class PointLight : public FaceMap {
 public:
  struct Options {
    Builder builder = Builder::Cover;
    int texels = 0;          ///< width and height of the map; 0: by the number of faces and their outline
    double field_angle = 0;  ///< radians; 0: fitted to the scene, 360 degrees for a light among the faces
    bool keep_all = false;   ///< keep faces behind full covers too (count_hits needs it)
    bool cut_outs = true;    ///< holes that materials make let light through; else every face is solid
    std::uint64_t max_texture_pixels = Scene::kMostTexturePixels;  ///< images of more make no holes
  };

  /// Throws Error if the position is not finite or an option is out of range, a field angle too narrow for
  /// the scene included: a face outside the field would be missed. (With keep_all a narrower field is taken:
  /// such a map is for looking at.)
  PointLight(const Scene& scene, const Vector& position, const Options& options);
  PointLight(const Scene& scene, const Vector& position) : PointLight(scene, position, Options()) {}

  Color color{1, 1, 1};
  float intensity = 1;

  /// What a caller knows of a point it sampled from a surface: at most one of the two.
  struct On {
    FaceId face =
        kNoFace;  ///< the point is meant to lie on this face: its projection onto the plane is asked, the face skipped
    float tolerance = 0;  ///< world units: a face blocks only if the point is farther than this from its plane
  };

  /// Whether nothing stands strictly between the light and a float32 point. No facing test; a point on a
  /// face's plane is not blocked by that face; the light's own position is lit. Exact with Builder::Cover.
  /// Throws Error for a point that is not finite, and for an On that is not as it says or names an odd face.
  bool get_lighten_up(const Vector& point, Counters* counters = nullptr) const {
    return get_lighten_up(point, On(), counters);
  }
  bool get_lighten_up(const Vector& point, const On& on, Counters* counters = nullptr) const;

  /// The same for many points at once, a few times as fast: lit[i] becomes 1 if points[i] is lit and 0 if not. In
  /// whatever order they come; neighbours one after the other are quicker. Throws Error if the spans differ in size
  /// or a point is not finite; lit is then partly written.
  void get_lighten_up(std::span<const Vector> points, std::span<std::uint8_t> lit, Counters* counters = nullptr) const;

  /// Whether the true point that a camera sees is lit: camera and light strictly on the same side of its face,
  /// and nothing strictly between. A light on the face's plane leaves it dark. Throws Error if the face is not one of
  /// the scene, and as is_blocked does.
  bool get_lighten_up(const SurfacePoint& point, Counters* counters = nullptr) const;

  /// The second half alone: whether some face stands strictly between the light and the true point. Throws
  /// Error if the ray lies along the plane of its face or is not finite: there is no point.
  bool is_blocked(const SurfacePoint& point, Counters* counters = nullptr) const;

 protected:
  PointLight(const MapFaces& faces, const Vector& position, const Options& options);

 private:
  PointLight(const MapFaces& faces, const SpaceVector& frame, const Options& options);

  // A chunk of get_lighten_up's points.
  void ask_together(std::span<const Vector> points, std::uint8_t* lit, Counters* counters) const;

  template <class Predicate>
  bool is_blocked_for_sure(std::span<const std::uint32_t> ids, bool is_cut, std::uint32_t skip,
                           const Predicate& blocks) const;

  // Faces without holes.
  template <class Point>
  bool is_blocked(const DVector& offset, const Point& point, std::uint32_t skip, float tolerance,
                  Counters* counters) const;

  // Faces with holes; `place` is the point in double.
  template <class Point>
  bool is_blocked_by_cut_outs(const DVector& offset, const Point& point, const DVector& place, std::uint32_t skip,
                              Counters* counters) const;
};

}  // namespace facemap
