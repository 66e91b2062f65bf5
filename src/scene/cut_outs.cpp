#include "scene/cut_outs.h"

#include <facemap/error.h>

#include <algorithm>
#include <array>
#include <map>
#include <new>
#include <set>
#include <utility>

#include "math/exact_sign.h"
#include "parallel/executor.h"
#include "scene/read_texture.h"
#include "scene/welded.h"

namespace facemap {
namespace {

using Kind = AlphaMask::Kind;

struct Image {
  DecodedImage pixels;  // none: it cannot be read
  std::string warning;
};

Image read(const TextureImage& image, std::uint64_t max_pixels) {
  try {
    return {read_texture(image, max_pixels), {}};
  } catch (const Error& error) {
    return {{}, error.what()};
  } catch (const std::bad_alloc&) {
    return {{}, image.name + ": not enough memory for the image"};
  }
}

// The images that materials take their opacity from, by number.
std::map<std::uint32_t, Image> read_images(const Scene& scene, std::uint64_t max_pixels, int threads) {
  std::map<std::uint32_t, Image> images;
  for (const Material& material : scene.materials()) {
    if (const TextureUse* use = image_of_opacity(material)) images.try_emplace(use->image);
  }
  std::vector<std::pair<const std::uint32_t, Image>*> tasks;
  for (auto& entry : images) tasks.push_back(&entry);
  const Executor executor(tasks.size() < 2 ? 1 : threads);
  executor.for_each(tasks.size(),
                    [&](std::size_t i, int) { tasks[i]->second = read(scene.images()[tasks[i]->first], max_pixels); });
  return images;
}

std::vector<AlphaMask> masks_of(const Scene& scene, const std::map<std::uint32_t, Image>& images) {
  std::vector<AlphaMask> masks;
  masks.reserve(scene.materials().size());
  for (const Material& material : scene.materials()) {
    const TextureUse* use = image_of_opacity(material);
    const DecodedImage* pixels = use != nullptr ? &images.at(use->image).pixels : nullptr;
    if (pixels != nullptr && !pixels->rgba.empty()) {
      masks.emplace_back(material, *pixels);
    } else {
      masks.emplace_back(material);
    }
  }
  return masks;
}

// A face without texture coordinates has the material's own opacity everywhere.
Kind kind_of(const Scene& scene, const std::vector<AlphaMask>& masks, std::size_t face) {
  const std::uint32_t material = scene.mesh().triangle_materials[face];
  if (material == kNoIndex) return Kind::Solid;
  const Material& m = scene.materials()[material];
  const bool has_image = image_of_opacity(m) != nullptr;
  return has_image && !has_texture_coordinates(scene.mesh(), face) ? AlphaMask(m).kind() : masks[material].kind();
}

bool is_duplicate(const Scene& scene, std::size_t face) {
  const Mesh& mesh = scene.mesh();
  return !scene.is_kept(face) && !repeats_vertex(welded_corners(mesh.triangles[face], scene.welded())) &&
         !is_degenerate(mesh.vertex(face, 0), mesh.vertex(face, 1), mesh.vertex(face, 2));
}

Corners places_of(const Scene& scene, std::size_t face) {
  Corners corners = welded_corners(scene.mesh().triangles[face], scene.welded());
  std::sort(corners.begin(), corners.end());
  return corners;
}

std::string warning_of(const Material& material) {
  return "material " + material.name + ": its opacity is below the cutoff everywhere; its faces are not shown";
}

}  // namespace

/// One byte a face: which are kept.
struct CutOuts::Sorted {
  std::vector<std::uint8_t> solid, cut;

  Sorted(const Scene& scene, const std::vector<AlphaMask>& masks) : solid(scene.face_count()), cut(scene.face_count()) {
    std::vector<std::size_t> solid_duplicates;
    for (std::size_t face = 0; face < scene.face_count(); ++face) {
      const Kind kind = kind_of(scene, masks, face);
      if (kind == Kind::Gone || !(scene.is_kept(face) || is_duplicate(scene, face))) continue;
      if (kind == Kind::CutOut) {
        cut[face] = 1;
      } else if (scene.is_kept(face)) {
        solid[face] = 1;
      } else {
        solid_duplicates.push_back(face);
      }
    }
    keep_lowest(scene, solid_duplicates);
  }

 private:
  // Solid faces that are duplicates of one that is not solid alone.
  void keep_lowest(const Scene& scene, const std::vector<std::size_t>& duplicates) {
    if (duplicates.empty()) return;
    std::set<Corners> open;
    for (const std::size_t face : duplicates) open.insert(places_of(scene, face));
    for (const std::uint32_t face : scene.kept_faces()) {
      if (solid[face] != 0) open.erase(places_of(scene, face));
    }
    for (const std::size_t face : duplicates) solid[face] = open.erase(places_of(scene, face)) != 0;
  }
};

CutOuts::CutOuts(const Scene& scene, std::vector<AlphaMask>&& masks, Sorted&& sorted,
                 std::vector<std::string>&& warnings)
    : masks_(std::move(masks)),
      solid_(scene, sorted.solid),
      cut_(scene, sorted.cut),
      shown_(scene,
             [&] {
               std::vector<std::uint8_t> both = std::move(sorted.solid);
               for (std::size_t face = 0; face < both.size(); ++face) both[face] |= sorted.cut[face];
               return both;
             }()),
      warnings_(std::move(warnings)) {}

std::shared_ptr<const CutOuts> CutOuts::find(const Scene& scene, std::uint64_t max_texture_pixels, int threads) {
  const std::vector<Material>& materials = scene.materials();
  const auto is_opaque = [](const Material& material) { return material.alpha == Material::Alpha::Opaque; };
  if (scene.mesh().triangle_materials.empty() || std::all_of(materials.begin(), materials.end(), is_opaque)) {
    return nullptr;
  }
  const std::map<std::uint32_t, Image> images = read_images(scene, max_texture_pixels, threads);
  std::vector<AlphaMask> masks = masks_of(scene, images);

  std::vector<std::string> warnings;
  for (const auto& [number, image] : images) {
    if (!image.warning.empty()) warnings.push_back(image.warning);
  }
  // Duplicates count: they are no longer ones beside a face of the other kind.
  bool has_holes = false;
  std::vector<std::uint8_t> is_gone(materials.size());
  for (std::size_t face = 0; face < scene.face_count(); ++face) {
    const Kind kind = kind_of(scene, masks, face);
    if (kind == Kind::Gone) is_gone[scene.mesh().triangle_materials[face]] = 1;
    has_holes = has_holes || kind != Kind::Solid;
  }
  for (std::size_t i = 0; i < materials.size(); ++i) {
    if (is_gone[i] != 0) warnings.push_back(warning_of(materials[i]));
  }
  if (!has_holes && warnings.empty()) return nullptr;
  Sorted sorted(scene, masks);
  return std::shared_ptr<const CutOuts>(new CutOuts(scene, std::move(masks), std::move(sorted), std::move(warnings)));
}

bool CutOuts::is_there(std::uint32_t face, const DVector& p, const DVector& d) const {
  const Mesh& mesh = cut_.mesh();
  const FaceCorners corners = corners_of(mesh, face);
  const DVector weights = barycentric(corners, point_on_plane(corners, p, d));
  return masks_[mesh.triangle_materials[face]].is_there(weighted(texture_corners_of(mesh, face).uv, weights));
}

}  // namespace facemap
