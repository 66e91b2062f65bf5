#include "material/brdf.h"

#include <algorithm>
#include <cmath>

#include "math/dvector.h"
#include "math/elementary.h"

namespace facemap {
namespace {

constexpr double kLn2 = 0x1.62e42fefa39efp-1;

// Cosines of views are kept above this: the masking term divides by them.
constexpr double kLeastCosine = 1e-4;

// A lobe below exp(-kFaint) of its peak is nothing: less than the last bit of any picture.
constexpr double kFaint = 40;

constexpr double kLargestExponent = 65536;

DVector cut(const DVector& x) {
  return {std::clamp(x.x, 0.0, 1.0), std::clamp(x.y, 0.0, 1.0), std::clamp(x.z, 0.0, 1.0)};
}

// (n.h)^e. MTL's Ks is how bright a highlight is at its peak, not how much light is in it: no factor.
double blinn_phong_lobe(double n_h, double exponent) {
  // 1 - x <= -log x: no logarithm where it is faint anyway.
  if (!(n_h > 0) || (1 - n_h) * exponent > kFaint) return 0;
  return elementary::pow(std::min(n_h, 1.0), exponent);
}

// What the lobe may be multiplied by to send on all light that comes along the normal, where it sends on most.
double largest_highlight(double exponent) {
  return (exponent + 2) * (exponent + 4) / (8 * (elementary::exp(-0.5 * kLn2 * exponent) + exponent));
}

// pi times the product of the GGX distribution and Smith's height-correlated visibility.
double ggx_lobe(double alpha, double n_h, double n_l, double n_v) {
  const double a2 = alpha * alpha;
  const double d = n_h * n_h * (a2 - 1) + 1;
  const double masking = n_l * std::sqrt(n_v * n_v * (1 - a2) + a2) + n_v * std::sqrt(n_l * n_l * (1 - a2) + a2);
  return a2 / (d * d) * (0.5 / masking);
}

double fifth_power(double x) {
  const double x2 = x * x;
  return x2 * x2 * x;
}

// Schlick's approximation.
DVector fresnel(const DVector& along_normal, double cosine) {
  return along_normal + (DVector(1) - along_normal) * fifth_power(std::clamp(1 - cosine, 0.0, 1.0));
}

}  // namespace

Reflection blinn_phong(const DVector& diffuse, const DVector& specular, double exponent) {
  Reflection result;
  result.diffuse = cut(diffuse);
  const DVector wanted = cut(specular);
  if (!(exponent > 0) || wanted == DVector(0)) return result;
  result.kind = Reflection::Kind::BlinnPhong;
  result.exponent = std::min(exponent, kLargestExponent);
  const DVector most = (DVector(1) - result.diffuse) * largest_highlight(result.exponent);
  result.specular = {std::min(wanted.x, most.x), std::min(wanted.y, most.y), std::min(wanted.z, most.z)};
  return result;
}

Reflection metal_rough(const DVector& base, double metallic, double roughness) {
  Reflection result;
  result.kind = Reflection::Kind::MetalRough;
  const DVector color = cut(base);
  const double metal = std::clamp(metallic, 0.0, 1.0);
  result.diffuse = color * (1 - metal);
  result.specular = DVector(kDielectric) * (1 - metal) + color * metal;
  const double rough = std::clamp(roughness, kLeastRoughness, 1.0);
  result.alpha = rough * rough;
  return result;
}

DVector reflected(const Reflection& surface, const DVector& normal, const DVector& light, const DVector& view) {
  if (surface.kind == Reflection::Kind::Diffuse) return surface.diffuse;
  const DVector half = normalized(light + view);
  const double n_h = dot(normal, half);
  if (surface.kind == Reflection::Kind::BlinnPhong) {
    return surface.diffuse + surface.specular * blinn_phong_lobe(n_h, surface.exponent);
  }
  const double n_l = std::max(dot(normal, light), kLeastCosine), n_v = std::max(dot(normal, view), kLeastCosine);
  const DVector mirrored = fresnel(surface.specular, dot(view, half));
  // Departs: glTF 2.0, appendix B, weighs the diffuse part by 1 - F(v.h), which sends on more light than comes at
  // grazing angles; what enters and leaves at n.l and n.v does not.
  const DVector entering =
      (DVector(1) - fresnel(surface.specular, n_l)) * (DVector(1) - fresnel(surface.specular, n_v));
  return surface.diffuse * entering + mirrored * ggx_lobe(surface.alpha, std::min(n_h, 1.0), n_l, n_v);
}

DVector reflected_ambient(const Reflection& surface) {
  if (surface.kind != Reflection::Kind::MetalRough) return surface.diffuse;
  return surface.diffuse * (DVector(1) - surface.specular) + surface.specular;
}

}  // namespace facemap
