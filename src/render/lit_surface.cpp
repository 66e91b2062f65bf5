#include "render/lit_surface.h"

#include "math/dvector.h"
#include "render/light_sources.h"

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

void LitSurface::add(const simd::LightSource& light) {
  if (look_.is_unlit) return;
  const auto [to_light, distance, share] = arrival(light, position_);
  if (!(distance > 0) || !(dot(face_normal_, to_light) > 0)) return;
  const double cosine = dot(look_.normal, to_light) / distance;
  if (!(cosine > 0)) return;
  const double strength = light.intensity * cosine * share;
  const DVector color(light.color[0], light.color[1], light.color[2]);
  radiance_ += color * strength * reflected(look_.reflection, look_.normal, to_light / distance, view_);
}

}  // namespace facemap
