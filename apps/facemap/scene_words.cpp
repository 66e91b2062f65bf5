#include "scene_words.h"

#include <facemap/error.h>

#include <algorithm>
#include <array>

#include "render_arguments.h"
#include "text_values.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

/// Options that a scene file has tables for, or that a file of others may not set: they name files that would be
/// written, or loosen what protects from it.
constexpr std::array kNotSettings = {"camera",
                                     "look-at",
                                     "light",
                                     "spot",
                                     "sun",
                                     "allow-outside",
                                     "max-faces",
                                     "max-bytes",
                                     "max-pixels",
                                     "quiet",
                                     "max-texture-pixels",
                                     "verbose",
                                     "log-json",
                                     "stats",
                                     "save-scene",
                                     "threads",
                                     "studio"};

/// Settings that a saved scene says in its tables.
constexpr std::array kSaidInTables = {"up",          "ground",      "scale",       "intensity",
                                      "camera-name", "field-angle", "file-camera", "file-lights",
                                      "opencv-pose", "strategy",    "map-memory"};

template <typename Names>
bool is_among(const std::string& name, const Names& names) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

bool may_be_set(const Option& option) {
  return !option.is_argument() && option.value.find("FILE") == std::string::npos &&
         !is_among(plain_name(option), kNotSettings);
}

std::string place_of(const SceneSetting& setting, const fs::path& file) {
  return file.string() + ":" + std::to_string(setting.line) + ":" + std::to_string(setting.column);
}

/// The settings whose names are among `known`; `keys`: what else the table may hold.
Words words_of(const std::vector<SceneSetting>& settings, const std::vector<std::string>& known, const char* table,
               const fs::path& file, const std::vector<std::string>& keys = {}) {
  Words words;
  for (const SceneSetting& setting : settings) {
    const std::string place = place_of(setting, file);
    if (!is_among(setting.name, known)) {
      std::vector<std::string> all = known;
      all.insert(all.end(), keys.begin(), keys.end());
      throw Error(place + ": unknown key \"" + setting.name + "\" in " + table + suggestion(setting.name, all) +
                  " (known: the flags of facemap render that shape the picture)");
    }
    for (const std::string& value : setting.values) words.push_back({setting.name, value, place});
  }
  return words;
}

void add_vector(Words& words, const char* name, const std::optional<Vector>& vector) {
  if (vector) words.push_back({name, text_of(*vector), ""});
}

}  // namespace

Words setting_words(const SceneFile& scene, const fs::path& file) {
  RenderArguments unused;
  std::vector<std::string> known;
  for (const Option& option : render_options(unused)) {
    if (may_be_set(option) && plain_name(option) != "opencv-pose") known.push_back(plain_name(option));
  }
  return words_of(scene.settings, known, "[settings]", file);
}

Words camera_words(const SceneCamera& camera, const fs::path& file) {
  RenderArguments unused;
  std::vector<std::string> known;
  for (const std::vector<Option>& options : {view_options(unused), lens_options(unused.frames.lens)}) {
    for (const Option& option : options) {
      const std::string name = plain_name(option);
      if (may_be_set(option) && name != "up" && name != "turntable" && name != "frames") known.push_back(name);
    }
  }
  Words words = words_of(camera.settings, known, "[[camera]]", file, {"name", "position", "look-at", "up"});
  add_vector(words, "camera", camera.position);
  add_vector(words, "look-at", camera.look_at);
  add_vector(words, "up", camera.up);
  return words;
}

SceneCamera scene_camera(const ModelCamera& camera) {
  SceneCamera result;
  result.name = camera.name;
  result.position = camera.position;
  result.look_at = camera.look_at;
  result.up = camera.up;
  if (camera.is_parallel) {
    const std::string height = text_of(static_cast<float>(camera.height));
    result.settings = {{"lens", {"orthographic"}, 0, 0}, {"ortho-height", {height}, 0, 0}};
  } else {
    result.settings = {{"lens", {"plane"}, 0, 0}, {"field-angle", {degrees_text(camera.field_angle)}, 0, 0}};
  }
  return result;
}

bool is_saved(const std::string& name) {
  RenderArguments unused;
  for (const Option& option : render_options(unused)) {
    if (plain_name(option) == name) return may_be_set(option) && !is_among(name, kSaidInTables);
  }
  return false;
}

}  // namespace facemap::program
