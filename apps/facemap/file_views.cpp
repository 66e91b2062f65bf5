#include "file_views.h"

#include <algorithm>

#include "scene_words.h"
#include "text_values.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

std::vector<SceneCamera> cameras_of(const Input& input, const Loaded& loaded) {
  if (!input.scene.cameras.empty()) return input.scene.cameras;
  std::vector<SceneCamera> cameras;
  for (const ModelCamera& camera : loaded.scene.cameras()) cameras.push_back(scene_camera(camera));
  return cameras;
}

std::string names_of(const std::vector<SceneCamera>& cameras) {
  std::string names;
  for (const SceneCamera& camera : cameras) names += (names.empty() ? "" : ", ") + camera.name;
  return names;
}

/// Rounded as degrees are printed, so that a saved scene has the same light.
void settle_angles(Light& light) {
  for (double* const angle : {&light.inner_angle, &light.outer_angle}) {
    if (*angle > 0) *angle = parse_degrees(degrees_text(*angle));
  }
}

/// By name, then by number.
std::vector<SceneCamera> chosen(const std::vector<SceneCamera>& cameras, const std::string& wanted) {
  if (wanted.empty()) return {cameras[0]};
  if (wanted == "all") return cameras;
  const auto named =
      std::find_if(cameras.begin(), cameras.end(), [&](const SceneCamera& camera) { return camera.name == wanted; });
  if (named != cameras.end()) return {*named};
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (wanted == std::to_string(i)) return {cameras[i]};
  }
  throw UsageError("--camera-name: '" + wanted + "' is none of the file's " + std::to_string(cameras.size()) +
                   " cameras: " + names_of(cameras));
}

}  // namespace

std::vector<WantedView> wanted_views(const RenderArguments& arguments, const Words& given, const Input& input,
                                     const Loaded& loaded) {
  const bool is_given = has(loaded.words, "camera") || has(loaded.words, "look-at") || has(loaded.words, "opencv-pose");
  const std::vector<SceneCamera> cameras = cameras_of(input, loaded);
  if (cameras.empty() && !arguments.camera_name.empty())
    throw UsageError("--camera-name: there is no camera in " + arguments.model.string());
  if (is_given || !arguments.file_camera || cameras.empty()) return arguments.frames.each();
  std::vector<WantedView> views;
  for (const SceneCamera& camera : chosen(cameras, arguments.camera_name)) {
    const Words words = merge_cameras(merge_cameras(given, camera_words(camera, arguments.model)), loaded.words);
    views.push_back(with_places(words, [&] { return arguments_of(words).frames.each().front(); }));
  }
  return views;
}

WantedLights wanted_lights(const RenderArguments& arguments, const Input& input, const Loaded& loaded) {
  WantedLights wanted{arguments.lights, false};
  if (wanted.lights.empty() && arguments.file_lights) {
    wanted.lights = input.scene.lights.empty() ? loaded.scene.lights() : input.scene.lights;
    for (Light& light : wanted.lights) settle_angles(light);
  }
  if (wanted.lights.empty()) wanted = {make_up_lights(loaded.ball, loaded.up), true};
  for (Light& light : wanted.lights) light.intensity *= arguments.intensity;
  return wanted;
}

}  // namespace facemap::program
