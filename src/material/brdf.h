#pragma once

#include <facemap/vector.h>

namespace facemap {

/// How a surface sends light on at one point: reflectances times pi, so that a white diffuse one is 1
/// (docs/materials.md has the formulas and where they come from). All are reciprocal and send no more light on than
/// they get.
struct Reflection {
  enum class Kind {
    Diffuse,     ///< Lambert alone
    BlinnPhong,  ///< with a Blinn-Phong lobe
    MetalRough,  ///< with a GGX lobe, Smith's masking and Schlick's Fresnel term
  };

  Kind kind = Kind::Diffuse;
  DVector diffuse{1};   ///< share of light sent on without a direction
  DVector specular{0};  ///< Blinn-Phong: the highlight at its peak; metal-rough: reflectance along the normal
  double exponent = 0;  ///< Blinn-Phong
  double alpha = 1;     ///< metal-rough: roughness squared
};

/// Roughness below this makes a highlight smaller than numbers can hold.
inline constexpr double kLeastRoughness = 0.04;

/// Reflectance of a dielectric along the normal: refractive index 1.5.
inline constexpr double kDielectric = 0.04;

/// Blinn-Phong: `specular` is cut to what the diffuse part leaves of light; an exponent of 0 has no highlight.
Reflection blinn_phong(const DVector& diffuse, const DVector& specular, double exponent);

/// glTF 2.0's metallic-roughness model; values are cut to 0..1.
Reflection metal_rough(const DVector& base, double metallic, double roughness);

/// pi f(light, view): radiance sent to `view` for a unit of irradiance from `light`, so to be multiplied by the
/// cosine. `normal`, `light` and `view` are unit vectors away from the surface, the light above it; a view below it, as
/// shading normals have it near silhouettes, is taken for a grazing one.
DVector reflected(const Reflection& surface, const DVector& normal, const DVector& light, const DVector& view);

/// Radiance sent on where light of radiance 1 comes from all directions, about; Blinn-Phong highlights are of lights
/// alone.
DVector reflected_ambient(const Reflection& surface);

}  // namespace facemap
