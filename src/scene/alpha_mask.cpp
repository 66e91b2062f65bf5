#include "scene/alpha_mask.h"

#include <algorithm>

#include "scene/texture_wrap.h"

namespace facemap {
namespace {

// Translucent surfaces are there or not: what lets more than half of the light through is not.
constexpr float kTranslucentCutoff = 0.5f;

float cutoff_of(const Material& material) {
  return material.alpha == Material::Alpha::Mask ? material.alpha_cutoff : kTranslucentCutoff;
}

bool is_opaque(const Material& material, float value) { return !(value * material.opacity < cutoff_of(material)); }

// One number of a texel, 0..1. The brightness (Rec. 709) of a grey texel is its grey, exactly: sums stay below 2^24.
float value_of(const std::uint8_t* rgba, int channel) {
  if (channel >= 0) return static_cast<float>(rgba[channel]) / 255.0f;
  return static_cast<float>(2126 * rgba[0] + 7152 * rgba[1] + 722 * rgba[2]) / 2550000.0f;
}

}  // namespace

const TextureUse* image_of_opacity(const Material& material) {
  if (material.alpha == Material::Alpha::Opaque) return nullptr;
  for (const TextureUse* use : {&material.opacity_map, &material.diffuse_map}) {
    if (use->is_used()) return use;
  }
  return nullptr;
}

AlphaMask::AlphaMask(const Material& material)
    : place_(use_),
      kind_(material.alpha == Material::Alpha::Opaque || is_opaque(material, 1) ? Kind::Solid : Kind::Gone) {}

AlphaMask::AlphaMask(const Material& material, const DecodedImage& image)
    : use_(*image_of_opacity(material)), place_(use_), width_(image.width), height_(image.height) {
  // Images that have alpha mean it; in others white is there and black is not.
  const bool is_colour = !material.opacity_map.is_used();
  const int channel = is_colour || (use_.channel < 0 && image.has_alpha) ? 3 : use_.channel;
  const float base = is_colour ? 0 : use_.base, gain = is_colour ? 1 : use_.gain;
  const std::size_t count = image.rgba.size() / 4;
  bits_.assign(count / 64 + 1, 0);
  std::size_t there = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const bool is_there = is_opaque(material, base + gain * value_of(&image.rgba[4 * i], channel));
    bits_[i / 64] |= std::uint64_t{is_there} << (i % 64);
    there += is_there;
  }
  kind_ = there == count ? Kind::Solid : there == 0 ? Kind::Gone : Kind::CutOut;
}

bool AlphaMask::is_there(const TexturePoint& uv) const {
  const TexturePoint place = place_.at(uv);
  const auto x = static_cast<std::size_t>(texel_under(place.x, width_, use_.wrap_u));
  const auto y = static_cast<std::size_t>(texel_under(place.y, height_, use_.wrap_v));
  const std::size_t texel = y * static_cast<std::size_t>(width_) + x;
  return (bits_[texel / 64] >> (texel % 64) & 1) != 0;
}

}  // namespace facemap
