#include "studio_words.h"

#include <algorithm>
#include <iterator>

#include "light_flags.h"
#include "text_values.h"

namespace facemap::program {
namespace {

/// Who says one of these wants another view than the studio's.
constexpr const char* kViewFlags[] = {"camera",      "look-at",      "field-angle",   "projection",
                                      "lens",        "cube-layout",  "camera-matrix", "distortion",
                                      "opencv-pose", "ortho-height", "camera-name"};

}  // namespace

Words studio_words(const Studio& studio, const Words& given) {
  Words words;
  const bool has_view =
      std::any_of(std::begin(kViewFlags), std::end(kViewFlags), [&](const char* flag) { return has(given, flag); });
  if (!has_view) {
    words.push_back({"camera", text_of(studio.view.position), ""});
    words.push_back({"look-at", text_of(studio.view.look_at), ""});
    words.push_back({"field-angle", degrees_text(studio.view.field_angle), ""});
    words.push_back({"lens", "plane", ""});
  }
  words.push_back({"up", text_of(studio.view.up), ""});
  if (!has(given, "light") && !has(given, "spot") && !has(given, "sun")) {
    for (const Light& light : studio.lights) {
      const std::string flag = flag_of(light);  // "--light ..."
      words.push_back({"light", flag.substr(flag.find(' ') + 1), ""});
    }
  }
  words.push_back({"ground", text_of(studio.ground.color), ""});
  words.push_back({"background", text_of(studio.background), ""});
  words.push_back({"sky", text_of(studio.sky_up) + "," + text_of(studio.sky_down), ""});
  words.push_back({"samples", "edges", ""});
  return words;
}

}  // namespace facemap::program
