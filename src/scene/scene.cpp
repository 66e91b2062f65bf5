#include <facemap/error.h>
#include <facemap/scene.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <glm/common.hpp>
#include <string>
#include <utility>

#include "parallel/executor.h"
#include "scene/odd_faces.h"
#include "simd/floating_point_mode.h"

namespace facemap {

namespace {

constexpr std::size_t kLeastPiece = 1 << 15;  ///< elements worth a task of their own
constexpr std::size_t kSmallScene = 1 << 16;  ///< faces below which threads cost more than they gain

/// Throws by `complain(i)` for the first element of 0..count-1 that is not right; `all_right(first, last)` is quick.
template <class AllRight, class Complain>
void check_each(const Executor& executor, std::size_t count, const AllRight& all_right, const Complain& complain) {
  std::atomic<bool> is_right = true;
  for_ranges(executor, count, kLeastPiece, [&](std::size_t first, std::size_t last, int) {
    if (!all_right(first, last)) is_right = false;
  });
  for (std::size_t i = 0; i < count && !is_right; ++i) complain(i);
}

bool is_finite(const Vector& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

void check_positions(const Executor& executor, const std::vector<Vector>& positions) {
  const auto all_finite = [&](std::size_t first, std::size_t last) {
    bool finite = true;  // without a branch for each
    for (std::size_t i = first; i != last; ++i) finite &= is_finite(positions[i]);
    return finite;
  };
  check_each(executor, positions.size(), all_finite, [&](std::size_t i) {
    if (!is_finite(positions[i])) throw Error("position " + std::to_string(i) + " is not finite");
  });
}

void check_indices(const Executor& executor, const std::vector<Corners>& corners, std::size_t limit, bool may_be_none,
                   const char* what) {
  const auto is_right = [=](std::uint32_t index) { return index < limit || (may_be_none && index == kNoIndex); };
  const auto all_right = [&](std::size_t first, std::size_t last) {
    bool right = true;
    for (std::size_t i = first; i != last; ++i) {
      const Corners& c = corners[i];
      right &= is_right(c[0]) & is_right(c[1]) & is_right(c[2]);
    }
    return right;
  };
  check_each(executor, corners.size(), all_right, [&](std::size_t i) {
    for (const std::uint32_t index : corners[i]) {
      if (is_right(index)) continue;
      throw Error("face " + std::to_string(i) + " refers to " + what + " " + std::to_string(index) + " of " +
                  std::to_string(limit));
    }
  });
}

/// An array that may be empty must otherwise have one value for each face (or position).
void check_size(std::size_t size, std::size_t wanted, const char* what) {
  if (size == 0 || size == wanted) return;
  throw Error(std::string(what) + ": " + std::to_string(size) + " values, not 0 or " + std::to_string(wanted));
}

void check(const Executor& executor, const Mesh& mesh, std::size_t material_count) {
  if (mesh.triangles.empty()) throw Error("a scene needs at least one face");
  if (mesh.triangles.size() > static_cast<std::size_t>(INT32_MAX)) throw Error("more than 2^31 - 1 faces");
  check_positions(executor, mesh.positions);
  check_size(mesh.colours.size(), mesh.positions.size(), "colours");
  check_size(mesh.normal_corners.size(), mesh.face_count(), "normal_corners");
  check_size(mesh.texture_corners.size(), mesh.face_count(), "texture_corners");
  check_size(mesh.polygons.size(), mesh.face_count(), "polygons");
  check_size(mesh.triangle_materials.size(), mesh.face_count(), "triangle_materials");
  check_indices(executor, mesh.triangles, mesh.positions.size(), false, "position");
  check_indices(executor, mesh.normal_corners, mesh.normals.size(), true, "normal");
  check_indices(executor, mesh.texture_corners, mesh.texture_coordinates.size(), true, "texture coordinate");
  for (const std::uint32_t material : mesh.triangle_materials) {
    if (material != kNoIndex && material >= material_count) {
      throw Error("material " + std::to_string(material) + " of " + std::to_string(material_count));
    }
  }
}

/// The bounds of the vertices of some faces, or of all positions, piece by piece.
class Bounds {
 public:
  Bounds(const Executor& executor, const Mesh& mesh, const std::vector<std::uint32_t>& faces)
      : executor_(executor), mesh_(mesh), faces_(faces) {}

  /// Of components that are equal, as 0 and -0 are, the first one stays: pieces are joined in their order.
  void find_box(Vector& lower, Vector& upper) const {
    std::vector<std::pair<Vector, Vector>> boxes(pieces());
    executor_.for_each(boxes.size(), [&](std::size_t piece, int) {
      const Vector start = vertex(begin(piece), 0);
      Vector low = start, high = start;
      for_each_vertex(piece, [&](const Vector& v) {
        low = glm::min(low, v);
        high = glm::max(high, v);
      });
      boxes[piece] = {low, high};
    });
    lower = boxes[0].first, upper = boxes[0].second;
    for (const auto& [low, high] : boxes) {
      lower = glm::min(lower, low);
      upper = glm::max(upper, high);
    }
  }

  /// The square of the distance of the vertex that is farthest from `centre`.
  double farthest_squared(const DVector& centre) const {
    std::vector<double> farthest(pieces(), 0);
    executor_.for_each(farthest.size(), [&](std::size_t piece, int) {
      double most = 0;
      for_each_vertex(piece, [&](const Vector& v) {
        const DVector d = DVector(v) - centre;
        most = std::max(most, d.x * d.x + d.y * d.y + d.z * d.z);
      });
      farthest[piece] = most;
    });
    return *std::max_element(farthest.begin(), farthest.end());
  }

 private:
  std::size_t count() const { return faces_.empty() ? mesh_.positions.size() : faces_.size(); }
  std::size_t pieces() const {
    if (executor_.threads() == 1) return 1;
    return std::clamp<std::size_t>(count() / kLeastPiece, 1, 4 * static_cast<std::size_t>(executor_.threads()));
  }
  std::size_t begin(std::size_t piece) const { return count() * piece / pieces(); }
  const Vector& vertex(std::size_t i, int corner) const {
    return faces_.empty() ? mesh_.positions[i] : mesh_.vertex(faces_[i], corner);
  }

  template <class Visit>
  void for_each_vertex(std::size_t piece, const Visit& visit) const {
    const std::size_t first = begin(piece), last = begin(piece + 1);
    if (faces_.empty()) {
      std::for_each(mesh_.positions.begin() + first, mesh_.positions.begin() + last, visit);
      return;
    }
    for (std::size_t i = first; i != last; ++i) {
      for (const std::uint32_t corner : mesh_.triangles[faces_[i]]) visit(mesh_.positions[corner]);
    }
  }

  const Executor& executor_;
  const Mesh& mesh_;
  const std::vector<std::uint32_t>& faces_;
};

/// The lower-case extension of a file's name, with its point.
std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace

Scene::Scene(Mesh mesh, std::vector<Material> materials, int threads)
    : mesh_(std::move(mesh)), materials_(std::move(materials)) {
  const FloatingPointMode mode;
  const Executor executor(face_count() < kSmallScene ? 1 : threads);
  check(executor, mesh_, materials_.size());
  welded_ = weld(mesh_.positions, executor);
  odd_ = find_odd_faces(mesh_, welded_, executor, kept_);
  const std::int64_t odd_count = odd_.zero_area + odd_.repeated_vertex + odd_.duplicate;
  kept_faces_.reserve(face_count() - static_cast<std::size_t>(odd_count));
  for (std::uint32_t face = 0; face < face_count(); ++face) {
    if (is_kept(face)) kept_faces_.push_back(face);
  }
  find_bounds(executor);
}

Scene Scene::load(const std::filesystem::path& path, int threads) {
  if (extension_of(path) != ".obj") {
    throw LoadError(LoadError::Cause::UnknownFormat, path.string(), 0, "unknown format; known: .obj");
  }
  OBJ obj = OBJ::load(path);
  OBJ::Report report = obj.report();
  std::vector<Material> materials = obj.materials();
  Scene scene(std::move(obj).mesh(), std::move(materials), threads);
  scene.report_ = std::move(report);
  return scene;
}

void Scene::find_bounds(const Executor& executor) {
  const Bounds bounds(executor, mesh_, kept_faces_);
  bounds.find_box(lower_, upper_);
  centre_ = (DVector(lower_) + DVector(upper_)) * 0.5;
  bounding_radius_ = std::sqrt(bounds.farthest_squared(centre_));
}

}  // namespace facemap
