#pragma once

#include <facemap/camera.h>
#include <facemap/counters.h>
#include <facemap/face.h>
#include <facemap/scene.h>
#include <facemap/vector.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

namespace facemap {

class CutOuts;
class NearestHit;

/// A raster on a plane perpendicular to a direction, whose texels hold the faces lying there: what a FaceMap is to a
/// point it is to a direction. The scene must outlive it. Const members may be called by several threads together.
///
/// An orthographic camera that looks along d has rays O + t d, t > 0, with a float32 origin O each:
///     const ParallelMap map(scene, d);
///     const Camera::Hit hit = map.nearest(O);
/// Origins in front of the whole scene are quick. Where the camera's plane cuts through the scene,
/// Options::keep_all keeps those behind it quick too; without it they are answered as exactly, but may ask every face.
class ParallelMap {
 public:
  struct Options {
    int texels = 0;         ///< about so many a side, fewer across the shorter one; 0: by the number of faces
    bool keep_all = false;  ///< keep faces behind full covers too
    bool cut_outs = true;   ///< holes that materials make are holes; else every face is solid
    std::uint64_t max_texture_pixels = Scene::kMostTexturePixels;  ///< images of more make no holes
  };

  /// `direction`: the way the light or the rays go, of any length. Throws Error if it is zero or not finite, or if
  /// there are less than 0 or more than 16384 texels.
  ParallelMap(const Scene& scene, const Vector& direction, const Options& options);
  ParallelMap(const Scene& scene, const Vector& direction) : ParallelMap(scene, direction, Options()) {}
  ~ParallelMap();
  ParallelMap(ParallelMap&&) noexcept;
  ParallelMap& operator=(ParallelMap&&) noexcept;

  const Scene& scene() const noexcept { return *scene_; }
  const Vector& direction() const noexcept { return direction_; }
  int width() const noexcept;
  int height() const noexcept;

  /// Exactly: -1 if the face is turned towards where the light or the rays come from, 1 if away, 0 if edge-on (met by
  /// nothing). 0 for odd faces. No bounds check.
  int side(FaceId face) const;

  /// The candidates of a texel, nearest bound first: a superset of the faces that any line along the direction through
  /// the texel meets, ended behind a face that covers the texel unless the map keeps all. Rows go down, columns to the
  /// right. No bounds check. Without those that materials cut holes into.
  std::span<const std::uint32_t> faces_at(int texel_x, int texel_y) const;

  /// The nearest face along the ray from `origin` that is there where it is met; none if it is not finite. Edges and
  /// vertices belong to their faces; a face through the origin is not seen. Of faces at exactly the same distance the
  /// one turned towards the camera wins, then the lower id. Exact. Hit::side is side() of the face.
  Camera::Hit nearest(const Vector& origin, Counters* counters = nullptr) const;

  /// The true point that `hit = nearest(origin)` sees, to ask lights about. `hit` must hold a face.
  SurfacePoint surface_point(const Vector& origin, const Camera::Hit& hit) const;

  std::size_t memory_bytes() const noexcept;  ///< of lists and planes
  std::size_t entry_count() const noexcept;   ///< in all lists

 protected:
  struct Parts;

  /// Of the faces without holes.
  const Parts& parts() const noexcept { return *parts_; }
  const Scene& solid_faces() const noexcept { return *solid_; }
  const Scene& all_faces() const noexcept { return *all_; }  ///< those in the map

  /// Of the others, if there are any.
  bool has_cut_outs() const noexcept { return cut_parts_ != nullptr; }
  const CutOuts& cut_outs() const noexcept { return *cut_outs_; }
  const Parts& cut_parts() const noexcept { return *cut_parts_; }

 private:
  NearestHit nearest_solid(const Vector& origin, Counters* counters) const;
  void meet_cut_outs(const Vector& origin, NearestHit& best, Counters* counters) const;

  const Scene *scene_, *all_, *solid_;
  Vector direction_;
  std::shared_ptr<const CutOuts> cut_outs_;  // null: all faces are solid
  std::unique_ptr<Parts> parts_, cut_parts_;
};

}  // namespace facemap
