#include <facemap/model.h>

#include <limits>

#include "render_arguments.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

bool parse_on_off(const std::string& text) { return parse_choice(text, {"off", "on"}) == 1; }

double parse_scale(const std::string& text) {
  const float factor = parse_number(text);
  if (!(factor > 0)) throw UsageError("'" + text + "' is not a number above 0");
  return factor;
}

WantedGround parse_ground(const std::string& text) {
  if (text == "none") return {true, std::nullopt};
  if (text == "on") return {false, std::nullopt};
  return {false, parse_color(text)};
}

Option on_off(const std::string& flags, const std::string& default_text, const std::string& help, bool& field) {
  return {flags, "on|off", default_text, help, into(field, parse_on_off), false, {"off", "on"}};
}

Option count(const std::string& flags, const std::string& default_text, const std::string& help, int most,
             std::function<void(int)> set) {
  return {flags, "N", default_text, help,
          [most, set](const std::string& text) { set(parse_whole_number(text, 1, most)); }};
}

}  // namespace

std::vector<Option> scene_options(RenderArguments& a) {
  return {
      {"--ambient", "COLOR", "0,0,0", "light from everywhere, which nothing hides: linear r,g,b or sRGB #rrggbb",
       into(a.options.ambient, parse_color)},
      {"--sky", "UP,DOWN", "0,0,0,0,0,0",
       "the same from above and from below: two colours, r,g,b,r,g,b or #rrggbb,#rrggbb",
       [&a](const std::string& text) {
         const auto [up, down] = parse_two_colors(text);
         a.options.sky_up = up;
         a.options.sky_down = down;
       }},
      on_off("--materials", "on", "the model's materials, textures and vertex colours; off: all is white",
             a.options.materials),
      {"--ground", "COLOR|none", "the scene file's",
       "a floor for shadows just below the model, of this colour (on: grey)", into(a.ground, parse_ground)},
      {"--scale", "FACTOR", "1", "how many times as large the model is taken", into(a.scale, parse_scale)},
      {"--studio", "", "",
       "what facemap MODEL does: a view that fills the picture, three lights, a ground and a sky; what "
       "other flags say goes before",
       [&a](const std::string&) { a.studio = true; }},
      {"--camera-name", "NAME|N|all", "the first",
       "which of the file's cameras is taken, by its name or its number from 0; all: a picture from each",
       into(a.camera_name, [](const std::string& text) { return text; })},
      on_off("--file-camera", "on", "a camera that stands in the file is used if no --camera or --look-at is given",
             a.file_camera),
      on_off("--file-lights", "on", "lights that stand in the file are used if no --light is given", a.file_lights),
      {"--save-scene", "FILE", "", "writes a scene file (TOML) that makes the same picture again",
       into(a.output.scene, [](const std::string& text) { return std::filesystem::path(text); })},
  };
}

std::vector<Option> limit_options(RenderArguments& a) {
  constexpr int kMostPixels = 1 << 30, kMost = std::numeric_limits<int>::max();
  return {
      {"--allow-outside", "", "", "opens textures and models outside of the folder of the file that names them",
       [&a](const std::string&) { a.limits.allow_outside = true; }},
      count("--max-faces", "100000000", "a file of more triangles is refused", kMost,
            [&a](int most) { a.limits.max_faces = static_cast<std::uint64_t>(most); }),
      {"--max-bytes", "SIZE", "16G", "a larger file is refused, and one that names such a file",
       into(a.limits.max_bytes, parse_memory)},
      count("--max-pixels", "268435456", "a larger --size is refused", kMostPixels,
            [&a](int most) { a.max_pixels = most; }),
      count("--max-texture-pixels", "67108864", "a larger texture is left out, with a warning", kMostPixels,
            [&a](int most) { a.options.max_texture_pixels = static_cast<std::uint64_t>(most); }),
  };
}

}  // namespace facemap::program
