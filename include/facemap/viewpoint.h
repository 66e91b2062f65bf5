#pragma once

#include <facemap/face.h>
#include <facemap/image.h>
#include <facemap/scene.h>
#include <facemap/vector.h>
#include <facemap/visible_faces.h>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace facemap {

/// All that a bundle of rays meets: of ray i elements begins[i] up to begins[i + 1], nearest first.
struct AllHits {
  std::vector<std::size_t> begins{0};  ///< one more than rays
  std::vector<FaceId> faces;
  std::vector<float> distances;  ///< from the rays' origin, world units
};

/// What is visible from a fixed point: a FaceMap that is asked about many points and directions at once. All answers
/// are exact for the float32 numbers given, on every machine, whatever the number of threads; docs/algorithm.md, 3.
/// The scene must outlive it. Const members may be called by several threads together.
class Viewpoint {
 public:
  struct Options {
    int threads = 0;       ///< 0: as many as the process may run at once
    bool cut_outs = true;  ///< holes that materials make are holes; else every face is solid
    std::uint64_t max_texture_pixels = Scene::kMostTexturePixels;  ///< images of more make no holes
  };

  /// Points to be asked about.
  struct Targets {
    std::span<const Vector> points;
    std::span<const FaceId> faces{};  ///< none, or one a point: the face that it lies on, which never hides it; kNoFace
    float tolerance = 0;  ///< world units: a face hides only points that are farther than this from its plane
  };

  /// A picture of directions: a surface projection (ProjectionKind), the distance from the middle being the angle.
  struct ImageOptions {
    int width = 1024;                        ///< pixels
    int height = 1024;                       ///< pixels
    double field_angle = 6.283185307179586;  ///< radians across the shorter side; 2 pi: all directions
    Vector sight{0};                         ///< direction in the middle; zero: towards the middle of the scene
  };

  /// Fraction done (0..1); called now and then, by one thread at a time, not always the caller's. Return false to
  /// stop: the call then throws Error.
  using Progress = std::function<bool(double)>;

  /// Throws Error if the origin is not finite or an option is out of range.
  Viewpoint(const Scene& scene, const Vector& origin, const Options& options);
  Viewpoint(const Scene& scene, const Vector& origin) : Viewpoint(scene, origin, Options()) {}
  ~Viewpoint();
  Viewpoint(Viewpoint&&) noexcept;
  Viewpoint& operator=(Viewpoint&&) noexcept;

  const Scene& scene() const noexcept;
  const Vector& origin() const noexcept;

  /// Makes now what visible() else makes once it has been asked about so many points that it pays.
  void prepare() const;

  /// visible[i] becomes 1 if no face stands strictly between the origin and point i, and 0 if one does. A point on a
  /// face's plane is not hidden by that face; the origin itself is visible. Throws Error if the sizes differ, a point
  /// is not finite, a face is not one of the scene, or the tolerance is below 0 or not finite.
  void visible(const Targets& targets, std::span<std::uint8_t> visible, const Progress& progress = {}) const;

  /// blockers[i] becomes the first face, seen from the origin, of those that stand strictly between it and point i, or
  /// kNoFace if the point is visible; of faces at exactly the same distance the one turned towards the origin, then
  /// the lower id. Throws Error as visible() does, and for a tolerance other than 0.
  void blocked_by(const Targets& targets, std::span<FaceId> blockers, const Progress& progress = {}) const;

  /// The nearest face along each direction (any length), as Camera::nearest has it, and the distance to it; kNoFace
  /// and infinity if there is none, for the zero vector and for what is not finite. Throws Error if the sizes differ.
  void nearest(std::span<const Vector> directions, std::span<FaceId> faces, std::span<float> distances,
               const Progress& progress = {}) const;

  /// Every face that each direction meets, in exact order of distance; of faces at the same distance the one turned
  /// towards the origin comes first, then the lower id. Nothing for the zero vector and for what is not finite.
  AllHits all_hits(std::span<const Vector> directions, const Progress& progress = {}) const;

  /// Wang 2022, Fig. 9: the darker a pixel, the more faces the ray through its centre meets (hit_color); pale blue
  /// where there is no direction. Its planes ids and depths hold the nearest. Throws Error if an option is out of
  /// range.
  Image image(const ImageOptions& options, const Progress& progress = {}) const;

  /// Which faces are visible, each with a direction that sees it, and which are hidden. Throws Error if stopped.
  VisibleFaces visible_faces(const Progress& progress = {}) const;

  /// Why visible_faces() calls a face hidden for HiddenReason::Covered: pieces that make up the face, each with what
  /// covers it. None for faces that are visible, left out or seen edge-on; for one that was left undecided it takes
  /// more time than visible_faces() does. Throws Error if there is no such face.
  std::vector<CoveredPiece> covered_pieces(FaceId face) const;

  /// For each vertex of the scene 1 if it is visible, as visible() has it, else 0.
  std::vector<std::uint8_t> visible_vertices(const Progress& progress = {}) const;

  /// Bytes of all that is kept.
  std::size_t memory_bytes() const;

 private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

}  // namespace facemap
