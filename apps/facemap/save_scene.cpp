#include "save_scene.h"

#include <cstdint>
#include <sstream>

#include "pending_files.h"
#include "report.h"
#include "scene_words.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

void add_setting(std::vector<SceneSetting>& settings, const std::string& name, const std::string& value) {
  for (SceneSetting& setting : settings) {
    if (setting.name == name) return setting.values.push_back(value);
  }
  settings.push_back({name, {value}, 0, 0});
}

/// What the flags of a view say beside place, target and up.
std::vector<SceneSetting> lens_settings(const View& view) {
  std::vector<SceneSetting> settings;
  std::istringstream words(flags_of(view));
  for (std::string flag, value; words >> flag >> value;) {
    if (flag != "--camera" && flag != "--look-at" && flag != "--up") add_setting(settings, flag.substr(2), value);
  }
  return settings;
}

SceneCamera camera_of(const View& view, const std::string& name) {
  return {name, view.position, view.look_at, view.up, lens_settings(view)};
}

std::vector<SceneSetting> settings_of(const Loaded& loaded, std::size_t cameras) {
  std::vector<SceneSetting> settings;
  add_setting(settings, "up", text_of(loaded.up));
  for (const Word& word : loaded.words) {
    if (is_saved(word.name)) add_setting(settings, word.name, word.text.empty() ? "on" : word.text);
  }
  if (cameras > 1) add_setting(settings, "camera-name", "all");
  return settings;
}

bool is_outside(const fs::path& model, const fs::path& folder) {
  std::error_code error;
  const fs::path relative = fs::relative(model, folder, error);
  return error || relative.empty() || *relative.begin() == "..";
}

}  // namespace

void check_names(const Input& input) {
  if (!input.bytes.empty()) throw UsageError("--save-scene: a model from standard input has no file to name");
  for (const SceneModel& model : input.scene.models) {
    if (!is_utf8(model.path.string()))
      throw UsageError("--save-scene: " + model.path.string() + ": a scene file can name only files in UTF-8");
  }
}

SceneFile scene_of(const Input& input, const Loaded& loaded, const RenderArguments& arguments,
                   const std::vector<View>& views, const std::vector<Light>& lights) {
  SceneFile scene;
  scene.models = input.scene.models;
  for (SceneModel& model : scene.models) {
    if (arguments.scale != 1) model.transform = Affine::scaling(DVector(arguments.scale)) * model.transform;
  }
  if (wants_ground(input, arguments)) {
    scene.ground = input.scene.ground.value_or(SceneGround());
    if (arguments.ground && arguments.ground->color) scene.ground->color = *arguments.ground->color;
  }
  // A turntable begins with its first view, and goes on by its setting.
  const std::size_t cameras = arguments.frames.turntable > 0 ? 1 : views.size();
  for (std::size_t i = 0; i < cameras; ++i) scene.cameras.push_back(camera_of(views[i], "view " + std::to_string(i)));
  scene.lights = lights;
  scene.settings = settings_of(loaded, cameras);
  return scene;
}

void save_scene(const SceneFile& scene, const fs::path& file) {
  const fs::path folder = file.has_parent_path() ? file.parent_path() : ".";
  const std::string text = scene_file_text(scene, folder);
  write_output(file, {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  for (const SceneModel& model : scene.models) {
    if (is_outside(model.path, folder)) {
      warn(file.string() + ": " + model.path.string() +
           " lies outside of its folder: rendering it needs --allow-outside");
    }
  }
}

}  // namespace facemap::program
