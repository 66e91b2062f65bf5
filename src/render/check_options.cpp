#include "render/check_options.h"

#include <facemap/error.h>

#include <cmath>

#include "math/dvector.h"
#include "math/elementary.h"

namespace facemap {
namespace {

bool is_valid(const Color& c) {
  return c.r >= 0 && c.g >= 0 && c.b >= 0 && std::isfinite(c.r) && std::isfinite(c.g) && std::isfinite(c.b);
}

bool is_finite(const Vector& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

}  // namespace

void check_light(const Light& light, const std::string& name) {
  const bool is_parallel = light.kind == Light::Kind::Directional;
  if (!is_parallel && !is_finite(light.position)) throw Error("position of " + name + " is not finite");
  if (!is_valid(light.color) || !(light.intensity >= 0) || !std::isfinite(light.intensity)) {
    throw Error("colour and intensity of " + name + " must be finite and not negative");
  }
  if (light.kind != Light::Kind::Point && (!is_finite(light.direction) || light.direction == Vector(0))) {
    throw Error("direction of " + name + " must be finite and not zero");
  }
  if (light.kind == Light::Kind::Spot &&
      !(light.inner_angle >= 0 && light.inner_angle <= light.outer_angle && light.outer_angle <= elementary::kPi)) {
    throw Error("angles of " + name + " must be 0 or more, the inner within the outer, and that within 180 degrees");
  }
  if (!is_parallel && !(light.range > 0)) throw Error("range of " + name + " must be above 0");
}

void check_options(const Renderer::Options& options) {
  if (options.samples < 1 || options.samples > 16) throw Error("samples a side of a pixel must be 1 to 16");
  if (options.crop) {
    const PixelBox& box = *options.crop;
    const bool is_inside = box.x >= 0 && box.y >= 0 && box.width >= 1 && box.height >= 1 &&
                           box.width <= options.width - box.x && box.height <= options.height - box.y;
    if (!is_inside) throw Error("crop must be at least one pixel and lie within the picture");
  }
  if (!(options.filter_width > 0) || !(options.filter_width <= 16)) {
    throw Error("the filter's width must be above 0 and at most 16 pixels");
  }
  if (!is_valid(options.background)) throw Error("background must be finite and not negative");
  if (!is_valid(options.ambient) || !is_valid(options.sky_up) || !is_valid(options.sky_down)) {
    throw Error("ambient and sky colours must be finite and not negative");
  }
  const double up = length(DVector(options.up));
  if (!(up > 0) || !std::isfinite(up)) throw Error("the up direction must be finite and not zero");
}

}  // namespace facemap
