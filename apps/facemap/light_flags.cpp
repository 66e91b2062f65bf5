#include "light_flags.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "text_values.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

constexpr double kPi = 3.14159265358979323846;

/// A value's parts between commas, taken one by one.
class Parts {
 public:
  Parts(const std::string& text, const char* expected) : text_(text), expected_(expected) {
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(',', begin), text.size());
      parts_.push_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
  }

  std::size_t left() const { return parts_.size() - next_; }

  float number() {
    try {
      return parse_number(take());
    } catch (const UsageError&) {
      refuse();
    }
  }

  double exact_number() {
    try {
      return parse_numbers(take())[0];
    } catch (const UsageError&) {
      refuse();
    }
  }

  Vector vector() {
    const float x = number(), y = number(), z = number();
    return {x, y, z};
  }

  Color color() {
    const Vector rgb = vector();
    if (rgb.x < 0 || rgb.y < 0 || rgb.z < 0) throw UsageError("'" + text_ + "': a colour's value is below 0");
    return {rgb.x, rgb.y, rgb.z};
  }

  /// Takes "falloff" and "range=R" off the end.
  void take_words(Light& light) {
    while (left() > 0) {
      const std::string& last = parts_.back();
      if (last == "falloff") {
        light.has_falloff = true;
      } else if (last.starts_with("range=")) {
        light.range = range_of(last.substr(6));
      } else {
        return;
      }
      parts_.pop_back();
    }
  }

  [[noreturn]] void refuse() const { throw UsageError("'" + text_ + "' is not " + expected_); }

 private:
  const std::string& take() {
    if (left() == 0) refuse();
    return parts_[next_++];
  }

  double range_of(const std::string& text) const {
    double range = 0;
    try {
      range = parse_numbers(text)[0];
    } catch (const UsageError&) {
      refuse();
    }
    if (!(range > 0)) refuse();
    return range;
  }

  const std::string& text_;
  const char* expected_;
  std::vector<std::string> parts_;
  std::size_t next_ = 0;
};

/// Half of the angle, radians.
double half_angle(double degrees) { return degrees / 2 * (kPi / 180); }

std::string words_of(const Light& light) {
  std::string words;
  if (light.range < HUGE_VAL) words += ",range=" + text_of(light.range);
  if (light.has_falloff) words += ",falloff";
  return words;
}

}  // namespace

Light parse_light(const std::string& text) {
  Parts parts(text, "a light x,y,z or x,y,z,r,g,b, with range=R or falloff at the end");
  Light light;
  parts.take_words(light);
  if (parts.left() != 3 && parts.left() != 6) parts.refuse();
  light.position = parts.vector();
  if (parts.left() > 0) light.color = parts.color();
  return light;
}

Light parse_spot(const std::string& text) {
  Parts parts(text,
              "a spot light x,y,z,dx,dy,dz,angle, then inner angle, r,g,b or both, with range=R or falloff at the end");
  Light light;
  light.kind = Light::Kind::Spot;
  parts.take_words(light);
  const std::size_t count = parts.left();
  if (count != 7 && count != 8 && count != 10 && count != 11) parts.refuse();
  light.position = parts.vector();
  light.direction = parts.vector();
  const double outer = parts.exact_number(), inner = count % 3 == 2 ? parts.exact_number() : 0;
  if (!(inner >= 0 && inner <= outer && outer <= 360)) {
    throw UsageError("'" + text + "': angles are 0 to 360 degrees, the inner one within the outer");
  }
  if (light.direction == Vector(0)) throw UsageError("'" + text + "': the direction is zero");
  light.outer_angle = half_angle(outer);
  light.inner_angle = half_angle(inner);
  if (parts.left() > 0) light.color = parts.color();
  return light;
}

Light parse_sun(const std::string& text) {
  Parts parts(text, "a directional light dx,dy,dz or dx,dy,dz,r,g,b");
  Light light;
  light.kind = Light::Kind::Directional;
  if (parts.left() != 3 && parts.left() != 6) parts.refuse();
  light.direction = parts.vector();
  if (light.direction == Vector(0)) throw UsageError("'" + text + "': the direction is zero");
  if (parts.left() > 0) light.color = parts.color();
  return light;
}

std::string flag_of(const Light& light) {
  const Color color = light.color * light.intensity;
  const std::string rgb = "," + text_of(Vector(color.r, color.g, color.b));
  switch (light.kind) {
    case Light::Kind::Spot:
      return "--spot " + text_of(light.position) + "," + text_of(light.direction) + "," +
             degrees_text(2 * light.outer_angle) + "," + degrees_text(2 * light.inner_angle) + rgb + words_of(light);
    case Light::Kind::Directional:
      return "--sun " + text_of(light.direction) + rgb;
    default:
      return "--light " + text_of(light.position) + rgb + words_of(light);
  }
}

std::string flags_of(const std::vector<Light>& lights) {
  std::string flags;
  for (const Light& light : lights) flags += (flags.empty() ? "" : " ") + flag_of(light);
  return flags;
}

}  // namespace facemap::program
