#pragma once

#include <facemap/material.h>
#include <facemap/mesh.h>
#include <facemap/model.h>
#include <facemap/obj.h>

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace facemap {

class CutOuts;
class Executor;
struct SmoothingRun;

/// Faces that are left out of every map, and why. Their ids stay theirs: nothing is renumbered.
struct OddFaces {
  std::int64_t zero_area = 0;        ///< corners exactly on one line, no vertex named twice
  std::int64_t repeated_vertex = 0;  ///< two corners name the same vertex
  std::int64_t duplicate = 0;        ///< the same three positions as a face of lower id, in any order
};

/// The triangles from `first_triangle` on, up to the next run, are part of `object`; kNoIndex: of none.
struct ObjectRun {
  std::size_t first_triangle;
  std::uint32_t object;
};

/// The geometry that maps are made of: a mesh, and which of its faces count. Immutable; maps keep a
/// reference, so a scene must outlive them. Threads may read it together. Copies share what they hold.
class Scene {
 public:
  /// Takes a mesh. Throws Error if a position is not finite, an index is out of range or no face is given. `threads`
  /// may work on a large one (0: as many as the process may run at once); the scene does not depend on them. There are
  /// no images: the materials' maps are left out.
  explicit Scene(Mesh mesh, std::vector<Material> materials = {}, int threads = 0);

  /// Takes all of a model but its objects. Throws Error as above, and if a material names an image
  /// that is not there.
  explicit Scene(Model model, int threads = 0);

  /// Reads a model file: OBJ, glTF, PLY or STL, by its content, or by its name where that does not say. Throws
  /// LoadError.
  static Scene load(const std::filesystem::path& path, int threads = 0);
  static Scene load(const std::filesystem::path& path, const ModelLimits& limits);

  const Mesh& mesh() const noexcept { return shared_->mesh; }
  const std::vector<Material>& materials() const noexcept { return shared_->materials; }
  const std::vector<TextureImage>& images() const noexcept { return shared_->images; }  ///< of materials, not decoded
  const std::vector<std::string>& objects() const noexcept {
    return shared_->objects;
  }                                                                              ///< names of the model's objects
  const std::vector<Light>& lights() const noexcept { return shared_->lights; }  ///< of the file
  const std::vector<ModelCamera>& cameras() const noexcept { return shared_->cameras; }  ///< of the file
  const std::optional<Vector>& up() const noexcept { return shared_->up; }               ///< as Model::up

  /// The index into objects() of what `face` is part of; kNoIndex: nothing.
  std::uint32_t object_of(std::size_t face) const;

  const OddFaces& odd_faces() const noexcept { return shared_->odd; }
  const OBJ::Report& report() const noexcept { return shared_->report; }

  /// Number of faces, the odd ones included.
  std::size_t face_count() const noexcept { return mesh().face_count(); }

  /// Whether `face` takes part in maps.
  bool is_kept(std::size_t face) const { return kept_[face] != 0; }

  /// Ids of the faces that take part, ascending.
  const std::vector<std::uint32_t>& kept_faces() const noexcept { return kept_faces_; }

  /// For each position, the index of the first position of the same value (-0 is 0); empty if no two are the same.
  const std::vector<std::uint32_t>& welded() const noexcept { return shared_->welded; }

  /// The axis-parallel box of the vertices of kept faces (of all positions if no face is kept).
  const Vector& lower() const noexcept { return lower_; }
  const Vector& upper() const noexcept { return upper_; }

  /// The bounding sphere about the box's centre: centre, and the distance of the farthest vertex.
  DVector centre() const noexcept { return centre_; }
  double bounding_radius() const noexcept { return bounding_radius_; }

  /// Images of more pixels are not decoded, unless it is asked for.
  static constexpr std::uint64_t kMostTexturePixels = std::uint64_t{1} << 26;

  /// What materials take away from faces: holes, and faces that are not to be seen at all (docs/materials.md). Null if
  /// nothing. Decodes the images that say so, the first time for each limit of their pixels; those that cannot be
  /// decoded count as none. `threads` may work on it. Maps and pictures ask for it by themselves.
  std::shared_ptr<const CutOuts> cut_outs(std::uint64_t max_texture_pixels = kMostTexturePixels, int threads = 0) const;

 private:
  friend class CutOuts;

  /// What does not depend on which faces count.
  struct Shared {
    Mesh mesh;
    std::vector<Material> materials;
    std::vector<TextureImage> images;
    std::vector<std::string> objects;
    std::vector<ObjectRun> object_runs;
    std::vector<Light> lights;
    std::vector<ModelCamera> cameras;
    std::optional<Vector> up;
    OBJ::Report report;
    OddFaces odd;
    std::vector<std::uint32_t> welded;
  };
  struct KnownCutOuts;

  /// The same mesh with other faces kept, all of them without holes.
  Scene(const Scene& whole, std::vector<std::uint8_t> kept);

  /// The same, and adds normals to the mesh where smoothing groups ask for them.
  Scene(Mesh mesh, std::vector<Material> materials, std::vector<TextureImage> images,
        const std::vector<SmoothingRun>& smoothing, int threads);

  void examine_faces(const Executor& executor);
  void list_kept_faces(const Executor& executor);
  void find_bounds(const Executor& executor);

  std::shared_ptr<Shared> shared_;                // not changed once the scene is made
  std::shared_ptr<KnownCutOuts> known_cut_outs_;  // null: there are none
  std::vector<std::uint8_t> kept_;
  std::vector<std::uint32_t> kept_faces_;
  Vector lower_{0}, upper_{0};
  DVector centre_{0};
  double bounding_radius_ = 0;
};

}  // namespace facemap
