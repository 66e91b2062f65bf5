#include "material/material_table.h"

#include <algorithm>

namespace facemap {
namespace {

// One number of a texel: the channel asked for, or how bright it is (Rec. 709).
double chosen(const TextureValue& value, int channel) {
  switch (channel) {
    case 0:
      return value.r;
    case 1:
      return value.g;
    case 2:
      return value.b;
    case 3:
      return value.a;
    default:
      return 0.2126 * value.r + 0.7152 * value.g + 0.0722 * value.b;
  }
}

}  // namespace

MaterialTable::Entry::Entry(const TextureSet& textures, const Material& from)
    : material(&from),
      diffuse(textures, from.diffuse_map, encoding_of_diffuse(from)),
      specular(textures, from.specular_map, Encoding::Srgb),
      emission(textures, from.emission_map, Encoding::Srgb),
      shininess(textures, from.shininess_map, Encoding::Linear),
      metallic(textures, from.metallic_map, Encoding::Linear),
      roughness(textures, from.roughness_map, Encoding::Linear),
      normal(textures, from.normal_map, Encoding::Linear),
      bump(textures, from.bump_map, Encoding::Linear) {
  const Map* const all[] = {&diffuse, &specular, &emission, &shininess, &metallic, &roughness, &normal, &bump};
  has_textures = std::any_of(std::begin(all), std::end(all), [](const Map* map) { return map->texture != nullptr; });
}

bool MaterialTable::is_needed(const Scene& scene) {
  return !scene.mesh().triangle_materials.empty() || !scene.mesh().colours.empty();
}

MaterialTable::MaterialTable(const Scene& scene, std::uint64_t max_pixels, const Executor& executor)
    : scene_(scene), textures_(scene, max_pixels, executor) {
  entries_.reserve(scene.materials().size());
  for (const Material& material : scene.materials()) entries_.emplace_back(textures_, material);
}

const MaterialTable::Entry* MaterialTable::entry_of(std::uint32_t face) const {
  const std::vector<std::uint32_t>& materials = scene_.mesh().triangle_materials;
  if (materials.empty() || materials[face] == kNoIndex) return nullptr;
  return &entries_[materials[face]];
}

bool MaterialTable::has_textures(std::uint32_t face) const {
  const Entry* const entry = entry_of(face);
  return entry != nullptr && entry->has_textures && has_texture_coordinates(scene_.mesh(), face);
}

void MaterialTable::set_up(FaceFrame& frame, std::uint32_t face) const {
  if (frame.face == face) return;
  frame.face = face;
  frame.corners = corners_of(scene_.mesh(), face);
  frame.coordinates = texture_corners_of(scene_.mesh(), face);
  frame.gradient = CoordinateGradient(frame.corners, frame.coordinates);
}

MaterialTable::Spot MaterialTable::spot_of(const SeenSurface& seen, const FaceFrame& frame) const {
  return {true, weighted(frame.coordinates.uv, seen.weights),
          footprint_of(frame.corners, frame.gradient, seen.camera, seen.rays)};
}

TextureValue MaterialTable::value(const Map& map, const Spot& spot, const TexturePoint& offset) {
  return map.texture->at(map.place.at(spot.uv) + offset, spot.footprint.on(map.place), *map.use);
}

DVector MaterialTable::colour(const Map& map, const Spot& spot, const Vector& factor) {
  if (map.texture == nullptr || !spot.is_known) return DVector(factor);
  const TextureValue texel = value(map, spot);
  return DVector(factor) * (DVector(texel.r, texel.g, texel.b) * double{map.use->gain} + double{map.use->base});
}

double MaterialTable::number(const Map& map, const Spot& spot, float factor) {
  if (map.texture == nullptr || !spot.is_known) return factor;
  return factor * (chosen(value(map, spot), map.use->channel) * map.use->gain + map.use->base);
}

// The normal in the image's frame: from a normal map, or from the slopes of heights, where one level of white above
// black and one texel are of equal length.
DVector MaterialTable::relief(const Entry& entry, const Spot& spot, const SeenSurface& seen, const FaceFrame& frame) {
  const Map& map = entry.normal.texture != nullptr ? entry.normal : entry.bump;
  if (map.texture == nullptr) return seen.normal;
  const TexturePoint places[3] = {map.place.at(frame.coordinates.uv[0]), map.place.at(frame.coordinates.uv[1]),
                                  map.place.at(frame.coordinates.uv[2])};
  const ImageAxes axes(frame.corners, places);
  const double strength = map.use->strength;
  if (&map == &entry.normal) {
    const TextureValue texel = value(map, spot);
    const DVector local((2 * double{texel.r} - 1) * strength, (2 * double{texel.g} - 1) * strength,
                        std::max(0.0, 2 * double{texel.b} - 1));
    return tilted(seen.normal, axes, local, seen.is_behind);
  }
  const double reach = map.texture->texels_across(spot.footprint.on(map.place));
  const TexturePoint right(reach / map.texture->width(), 0), up(0, -reach / map.texture->height());
  const auto height = [&](const TexturePoint& offset) { return chosen(value(map, spot, offset), map.use->channel); };
  const double per_texel = strength * map.use->gain / (2 * reach);
  const DVector local((height(-right) - height(right)) * per_texel, (height(-up) - height(up)) * per_texel, 1);
  return tilted(seen.normal, axes, local, seen.is_behind);
}

Reflection MaterialTable::reflection(const Entry& entry, const Spot& spot, const DVector& diffuse) {
  const Material& material = *entry.material;
  if (material.kind == Material::Kind::MetalRough) {
    return metal_rough(diffuse, number(entry.metallic, spot, material.metallic),
                       number(entry.roughness, spot, material.roughness));
  }
  if (material.illumination < 2 || !(material.shininess > 0)) return blinn_phong(diffuse, DVector(0), 0);
  return blinn_phong(diffuse, colour(entry.specular, spot, material.specular),
                     number(entry.shininess, spot, material.shininess));
}

SurfaceLook MaterialTable::look(const SeenSurface& seen, FaceFrame& frame) const {
  SurfaceLook look;
  look.normal = seen.normal;
  DVector tint(1);
  const Mesh& mesh = scene_.mesh();
  if (!mesh.colours.empty()) {
    const Corners& corners = mesh.triangles[seen.face];
    const DVector colours[3] = {DVector(mesh.colours[corners[0]]), DVector(mesh.colours[corners[1]]),
                                DVector(mesh.colours[corners[2]])};
    tint = weighted(colours, seen.weights);
  }
  const Entry* const entry = entry_of(seen.face);
  if (entry == nullptr) {
    look.albedo = tint;
    look.reflection = blinn_phong(tint, DVector(0), 0);
    return look;
  }
  Spot spot;
  if (has_textures(seen.face)) {
    set_up(frame, seen.face);
    spot = spot_of(seen, frame);
    look.normal = relief(*entry, spot, seen, frame);
  }
  const DVector diffuse = colour(entry->diffuse, spot, entry->material->diffuse) * tint;
  look.albedo = diffuse;
  look.is_unlit = entry->material->is_unlit;
  if (look.is_unlit) {
    look.emission = diffuse;
    return look;
  }
  look.emission = colour(entry->emission, spot, entry->material->emission);
  look.reflection = reflection(*entry, spot, diffuse);
  return look;
}

}  // namespace facemap
