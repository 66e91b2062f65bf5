#include "render/lit_surface.h"

#include <cmath>

#include "math/dvector.h"

namespace facemap {

LitSurface::LitSurface(const SeenSurface& seen, const SurfaceLook& look, const DVector& position,
                       const Surroundings& surroundings)
    : look_(look),
      face_normal_(seen.normal),
      position_(position),
      view_(normalized(-DVector(seen.rays.through))),
      radiance_(look.emission) {
  if (!look.is_unlit) radiance_ += surroundings.at(look.normal) * reflected_ambient(look.reflection);
}

void LitSurface::add(const DVector& light, const DVector& color, double intensity, bool inverse_square) {
  if (look_.is_unlit) return;
  const DVector to_light = light - position_;
  const double squared = dot(to_light, to_light);
  if (!(squared > 0) || !(dot(face_normal_, to_light) > 0)) return;
  const double distance = std::sqrt(squared);
  const double cosine = dot(look_.normal, to_light) / distance;
  if (!(cosine > 0)) return;
  const double strength = intensity * cosine * (inverse_square ? 1 / squared : 1);
  radiance_ += color * strength * reflected(look_.reflection, look_.normal, to_light / distance, view_);
}

}  // namespace facemap
