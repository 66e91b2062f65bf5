#pragma once

#include <facemap/counters.h>
#include <facemap/face.h>
#include <facemap/projection.h>
#include <facemap/scene.h>
#include <facemap/space_vector.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace facemap {

class CutOuts;
class FacePlanesTable;
struct MapFaces;
class Texels;

/// How the texels of a map get their faces.
enum class Builder {
  Cover,  ///< every texel that a face touches, never one too few: exact answers
  Fill,   ///< as published (Alg. 2 to 4): texels under edge curves and those whose centres lie between; can miss a face
          ///< at its edge
};

/// A raster of directions about one fixed point whose texels hold the faces lying there. Wang 2022, sec. 4.
/// Abstract: a Camera keeps what is nearest, a PointLight keeps all. The scene must outlive the map.
/// Const members may be called by several threads together.
class FaceMap : public SpaceVector {
 public:
  virtual ~FaceMap() = 0;
  FaceMap(FaceMap&&) noexcept;
  FaceMap& operator=(FaceMap&&) noexcept;

  const Scene& scene() const noexcept { return *scene_; }
  const Projection& projection() const noexcept { return projection_; }
  Builder builder() const noexcept { return builder_; }
  int width() const noexcept { return projection_.width(); }
  int height() const noexcept { return projection_.height(); }

  /// Side of the face's plane on which the map's origin lies, exactly: -1 the face is turned towards it, 1
  /// away, 0 seen edge-on (hit by nothing). 0 for odd faces, which are in no map. No bounds check.
  int side(FaceId face) const;

  /// The candidates of a texel, nearest bound first: with Builder::Cover a superset of the faces that any
  /// direction in the texel meets, ended behind a face that covers the texel unless the map keeps all. No bounds check.
  /// Without those that materials cut holes into (docs/materials.md), which never hide what is behind them.
  std::span<const std::uint32_t> faces_at(int texel_x, int texel_y) const;

  /// The others, all of them: whether they are there is asked where a ray meets them.
  std::span<const std::uint32_t> cut_outs_at(int texel_x, int texel_y) const;

  /// The texel that holds a world direction; none outside the raster, for the zero vector and for what is not finite.
  /// Its length may be anything from 1e-150 to 1e150: squares must be doubles.
  struct Texel {
    int x, y;
  };
  std::optional<Texel> texel_of(const DVector& direction) const;

  /// How many faces the ray from the origin along `direction` meets where they are there, edges and vertices included;
  /// exact if the map keeps all (Options::keep_all) and is built by Cover. 0 outside the raster and for a direction
  /// that is zero or not finite.
  int count_hits(const Vector& direction, Counters* counters = nullptr) const;

  /// Bytes of lists and planes.
  std::size_t memory_bytes() const noexcept;

  /// Those of lists alone.
  std::size_t list_bytes() const noexcept;

  /// Entries in all lists.
  std::size_t entry_count() const noexcept;

 protected:
  /// `planes`: of all faces about the frame's position, if they are made already.
  FaceMap(const MapFaces& faces, const SpaceVector& frame, const Projection& projection, Builder builder, bool keep_all,
          std::shared_ptr<const FacePlanesTable> planes = nullptr);

  const FacePlanesTable& planes() const noexcept { return *planes_; }
  const Texels& texels() const noexcept { return *texels_; }
  const Scene& all_faces() const noexcept { return *all_; }      ///< those in the map
  const Scene& solid_faces() const noexcept { return *solid_; }  ///< those without holes, in texels()

  /// Whether some faces of the map have holes: those in cut_texels().
  bool has_cut_outs() const noexcept { return cut_texels_ != nullptr; }
  const CutOuts& cut_outs() const noexcept { return *cut_outs_; }
  const Texels& cut_texels() const noexcept { return *cut_texels_; }

 private:
  const Scene *scene_, *all_, *solid_;
  std::shared_ptr<const CutOuts> cut_outs_;  // null: all faces are solid
  Projection projection_;
  Builder builder_;
  std::shared_ptr<const FacePlanesTable> planes_;
  std::unique_ptr<Texels> texels_;
  std::unique_ptr<Texels> cut_texels_;  // null: there are none
};

}  // namespace facemap
