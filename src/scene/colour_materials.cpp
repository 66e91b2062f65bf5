#include "scene/colour_materials.h"

#include <facemap/color.h>

#include <string>

namespace facemap {

namespace {

std::string hexadecimal(std::uint32_t rgb) {
  std::string digits;
  for (int shift = 20; shift >= 0; shift -= 4) digits.push_back("0123456789abcdef"[rgb >> shift & 15]);
  return digits;
}

}  // namespace

std::uint32_t ColourMaterials::of(std::uint32_t rgb) {
  if (rgb == last_rgb_) return last_material_;
  const auto found = known_.find(rgb);
  if (found == known_.end() && known_.size() == kMost) return kNoIndex;
  last_rgb_ = rgb;
  if (found != known_.end()) return last_material_ = found->second;

  Material material;
  material.name = "colour " + hexadecimal(rgb);
  const Color linear = Color::from_24_bit(rgb);
  material.diffuse = Vector(linear.r, linear.g, linear.b);
  last_material_ = static_cast<std::uint32_t>(materials_.size());
  materials_.push_back(std::move(material));
  known_.emplace(rgb, last_material_);
  return last_material_;
}

}  // namespace facemap
