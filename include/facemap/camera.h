#pragma once

#include <facemap/face_map.h>
#include <facemap/surface_point.h>

#include <cstdint>
#include <limits>

namespace facemap {

class NearestHit;

/// The FaceMap that keeps the faces closest to itself and answers which is nearest along a ray.
/// Wang 2022, sec. 4.3: the Camera class.
///
/// A texel keeps every face that may be nearest for some direction in it, not only for its centre, so that
/// rays elsewhere in the pixel are answered exactly too.
class Camera : public FaceMap {
 public:
  struct Options {
    ProjectionKind projection = ProjectionKind::Surface;
    double field_angle = 0.87266462599716477;  ///< radians (50 degrees); see Projection
    int width = 1024;                          ///< pixels
    int height = 1024;                         ///< pixels
    Builder builder = Builder::Cover;
    bool keep_all = false;  ///< keep faces behind full covers too (count_hits needs it)
    bool cut_outs = true;   ///< holes that materials make are holes; else every face is solid
    std::uint64_t max_texture_pixels = Scene::kMostTexturePixels;  ///< images of more make no holes
  };

  /// Throws Error for options out of range.
  Camera(const Scene& scene, const SpaceVector& frame, const Options& options);

  /// World direction through a map point, rounded to float32: from there on it is exact input. The zero vector
  /// where the projection has no direction (surface: more than 180 degrees from the axis).
  Vector direction_through(const MapPoint& point) const;

  struct Hit {
    FaceId face = kNoFace;
    float depth = std::numeric_limits<float>::infinity();  ///< distance along the ray in world units
    bool strictly_inside = false;                          ///< not on an edge or a vertex of the face
    bool tied = false;                                     ///< another face is met at exactly the same distance
    int side = 0;                                          ///< of the face, as FaceMap::side

    explicit operator bool() const noexcept { return face != kNoFace; }
  };

  /// The nearest face along `direction` (any length) that is there where it is met; none for the zero vector, for what
  /// is not finite and outside the raster. Edges and vertices belong to their faces. Of faces at exactly the same
  /// distance the one turned towards the camera wins, then the lower id. Exact with Builder::Cover.
  Hit nearest(const Vector& direction, Counters* counters = nullptr) const;

  /// The true point that `hit = nearest(direction)` sees. `hit` must hold a face.
  SurfacePoint surface_point(const Vector& direction, const Hit& hit) const;

 protected:
  Camera(const MapFaces& faces, const SpaceVector& frame, const Options& options);
  Camera(const MapFaces& faces, const SpaceVector& frame, const Projection& projection,
         std::shared_ptr<const FacePlanesTable> planes, bool keep_all);

  /// Tells `best` of the faces of the map that the ray meets, but for some that are behind what it knows already.
  /// `texel` must be texel_of(direction).
  void meet_faces(const Texel& texel, const Vector& direction, NearestHit& best, Counters* counters) const;
};

}  // namespace facemap
