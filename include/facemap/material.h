#pragma once

#include <facemap/texture.h>
#include <facemap/vector.h>

#include <string>

namespace facemap {

/// What a surface is made of, as an MTL file or a glTF model states it. docs/materials.md says how it is shaded.
struct Material {
  enum class Kind {
    Phong,       ///< diffuse and Blinn-Phong highlights (MTL)
    MetalRough,  ///< metallic and rough (glTF; MTL with Pr or Pm): `diffuse` is the base colour
  };
  enum class Alpha {
    Opaque,
    Mask,   ///< cut out where opacity times map is below `alpha_cutoff`
    Blend,  ///< translucent
  };

  std::string name;           ///< newmtl
  Vector ambient{0};          ///< Ka; not used
  Vector diffuse{0.8f};       ///< Kd, linear RGB
  Vector specular{0};         ///< Ks
  Vector emission{0};         ///< Ke
  float shininess = 0;        ///< Ns; 0: no highlight
  float optical_density = 1;  ///< Ni
  float opacity = 1;          ///< d, or 1 - Tr
  bool is_halo = false;       ///< d -halo: more opaque towards the silhouette; not used
  int illumination = 2;       ///< illum; below 2: no highlight
  Kind kind = Kind::Phong;
  float metallic = 0;   ///< 0..1
  float roughness = 1;  ///< 0..1
  Alpha alpha = Alpha::Opaque;
  float alpha_cutoff = 0.5f;
  bool is_double_sided = true;
  bool is_unlit = false;     ///< its colour is what is seen, whatever the lights
  TextureUse diffuse_map;    ///< times `diffuse`, sRGB; its alpha times `opacity` unless there is an opacity_map
  TextureUse opacity_map;    ///< times `opacity`
  TextureUse specular_map;   ///< times `specular`, sRGB
  TextureUse shininess_map;  ///< times `shininess`
  TextureUse emission_map;   ///< times `emission`, sRGB
  TextureUse metallic_map;   ///< times `metallic`
  TextureUse roughness_map;  ///< times `roughness`
  TextureUse normal_map;     ///< tangent space, +x right and +y up in the image
  TextureUse bump_map;       ///< heights; unless there is a normal_map
};

}  // namespace facemap
