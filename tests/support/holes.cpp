#include "support/holes.h"

#include <algorithm>
#include <cmath>

#include "image/decode_image.h"
#include "math/elementary.h"

namespace oracle {
namespace {

using facemap::Material;
using facemap::TextureUse;
using facemap::Vector;
using Point = Holes::Point;

Point minus(const Point& a, const Point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Point& a, const Point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Point cross(const Point& a, const Point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Point in_doubles(const Vector& v) { return {v.x, v.y, v.z}; }

std::array<Point, 4> corners_and_normal(const std::array<Vector, 3>& v) {
  const Point a = in_doubles(v[0]), b = in_doubles(v[1]), c = in_doubles(v[2]);
  return {a, b, c, cross(minus(b, a), minus(c, a))};
}

// Which of `size` texels a coordinate falls into.
int texel(double x, int size, TextureUse::Wrap wrap) {
  if (std::fabs(x) >= std::ldexp(1.0, 40)) x = 0;
  if (wrap == TextureUse::Wrap::Clamp) {
    const double i = std::floor(std::min(std::max(x, -1.0), 2.0) * size);
    return i < 0 ? 0 : i >= size ? size - 1 : static_cast<int>(i);
  }
  const int period = wrap == TextureUse::Wrap::Mirror ? 2 : 1;
  const double within = period == 2 ? x - 2 * std::floor(x / 2) : x - std::floor(x);
  int i = static_cast<int>(std::floor(within * size));
  if (period == 2) return i < size ? i : std::max(0, 2 * size - 1 - i);
  return i == size ? 0 : i;
}

}  // namespace

Holes::Holes(const facemap::Mesh& mesh, const std::vector<Material>& materials,
             const std::vector<facemap::TextureImage>& images)
    : mesh_(&mesh) {
  for (const Material& m : materials) {
    Surface surface;
    const float cutoff = m.alpha == Material::Alpha::Mask ? m.alpha_cutoff : 0.5f;
    const bool has_map = m.opacity_map.is_used() || m.diffuse_map.is_used();
    const bool is_gone = m.alpha != Material::Alpha::Opaque && m.opacity < cutoff;
    surface.kind = surface.kind_without_places = is_gone ? Kind::Gone : Kind::Solid;
    if (m.alpha != Material::Alpha::Opaque && has_map) {
      surface.use = m.opacity_map.is_used() ? m.opacity_map : m.diffuse_map;
      const facemap::DecodedImage image = facemap::decode_image(images[surface.use.image].bytes, "image", 1 << 20);
      surface.width = image.width;
      surface.height = image.height;
      bool has_alpha = false;
      for (std::size_t i = 3; i < image.rgba.size(); i += 4) has_alpha = has_alpha || image.rgba[i] != 255;
      for (std::size_t i = 0; i < image.rgba.size(); i += 4) {
        const std::uint8_t* t = &image.rgba[i];
        float value = static_cast<float>(t[3]) / 255;
        if (m.opacity_map.is_used()) {
          if (surface.use.channel >= 0) {
            value = static_cast<float>(t[surface.use.channel]) / 255;
          } else if (!has_alpha) {
            // 0.2126 red, 0.7152 green and 0.0722 blue, rounded once.
            value = static_cast<float>(2126 * t[0] + 7152 * t[1] + 722 * t[2]) / (255 * 10000);
          }
          value = surface.use.base + surface.use.gain * value;
        }
        surface.there.push_back(value * m.opacity >= cutoff);
      }
      const auto there = std::count(surface.there.begin(), surface.there.end(), true);
      surface.kind = there == 0                                                ? Kind::Gone
                     : static_cast<std::size_t>(there) == surface.there.size() ? Kind::Solid
                                                                               : Kind::CutOut;
    }
    surfaces_.push_back(surface);
  }
}

Holes::Kind Holes::kind(facemap::FaceId face) const {
  if (mesh_->triangle_materials.empty()) return Kind::Solid;
  const std::uint32_t material = mesh_->triangle_materials[face];
  if (material == facemap::kNoIndex) return Kind::Solid;
  bool has_places = false;
  for (int k = 0; k < 3 && !mesh_->texture_corners.empty(); ++k) {
    has_places = has_places || mesh_->texture_corners[face][k] != facemap::kNoIndex;
  }
  return has_places ? surfaces_[material].kind : surfaces_[material].kind_without_places;
}

Point Holes::crossing(const std::array<Vector, 3>& corners, const Point& p, const Point& d) {
  const auto [a, b, c, n] = corners_and_normal(corners);
  const double t = dot(n, minus(a, p)) / dot(n, d);
  if (!std::isfinite(t)) return a;
  return {p[0] + d[0] * t, p[1] + d[1] * t, p[2] + d[2] * t};
}

bool Holes::is_there(facemap::FaceId face, const Point& p, const Point& d) const {
  const std::array<Vector, 3> v = {mesh_->vertex(face, 0), mesh_->vertex(face, 1), mesh_->vertex(face, 2)};
  const auto [a, b, c, n] = corners_and_normal(v);
  const Point x = crossing(v, p, d);
  // Twice the areas opposite the corners, times |n|.
  double weights[3] = {dot(n, cross(minus(c, b), minus(x, b))), dot(n, cross(minus(a, c), minus(x, c))),
                       dot(n, cross(minus(b, a), minus(x, a)))};
  for (double& weight : weights) weight = weight > 0 ? weight : 0;
  const double sum = weights[0] + weights[1] + weights[2];
  for (double& weight : weights) weight = sum > 0 ? weight * (1 / sum) : 1.0 / 3;

  double us[3], ups[3];
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t corner = mesh_->texture_corners[face][k];
    const glm::vec2 place = corner == facemap::kNoIndex ? glm::vec2(0) : mesh_->texture_coordinates[corner];
    us[k] = place.x;
    ups[k] = place.y;
  }
  const double u = us[0] * weights[0] + us[1] * weights[1] + us[2] * weights[2];
  const double up = ups[0] * weights[0] + ups[1] * weights[1] + ups[2] * weights[2];
  const Surface& surface = surfaces_[mesh_->triangle_materials[face]];
  const TextureUse& use = surface.use;
  const double cosine = facemap::elementary::cos(use.rotation), sine = facemap::elementary::sin(use.rotation);
  const double turned_x = cosine * use.scale.x * u + -sine * use.scale.y * up;
  const double turned_y = sine * use.scale.x * u + cosine * use.scale.y * up;
  const double place_x = use.offset.x + turned_x;
  const double place_y = use.is_v_down ? use.offset.y + turned_y : (1 - double{use.offset.y}) + -turned_y;
  const int column = texel(place_x, surface.width, use.wrap_u), row = texel(place_y, surface.height, use.wrap_v);
  return surface.there[static_cast<std::size_t>(row) * surface.width + column];
}

}  // namespace oracle
