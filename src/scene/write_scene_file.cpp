#include <facemap/atomic_file.h>
#include <facemap/error.h>
#include <facemap/scene_file.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "scene/scene_numbers.h"

namespace facemap {

namespace {

namespace fs = std::filesystem;

/// A basic string of TOML.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      result += '\\';
      result += c;
    } else if (code < 0x20 || code == 0x7f) {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\u%04x", code);
      result += escaped;
    } else {
      result += c;
    }
  }
  return result + "\"";
}

template <typename V>
std::string vector_text(const V& v) {
  return "[" + shortest_text(v.x) + ", " + shortest_text(v.y) + ", " + shortest_text(v.z) + "]";
}

std::string color_text(const Color& color) { return vector_text(Vector(color.r, color.g, color.b)); }

std::string row(const std::string& key, const std::string& value) { return key + " = " + value + "\n"; }

std::string matrix_text(const Affine& t) {
  std::string text = "[";
  for (int i = 0; i < 3; ++i) {
    text += "[" + shortest_text(t.x[i]) + ", " + shortest_text(t.y[i]) + ", " + shortest_text(t.z[i]) + ", " +
            shortest_text(t.origin[i]) + "], ";
  }
  return text + "[0, 0, 0, 1]]";
}

std::string transform_text(const Affine& transform) {
  if (transform == Affine()) return "";
  if (transform == Affine::scaling(DVector(transform.x.x))) return row("scale", shortest_text(transform.x.x));
  if (transform == Affine::translation(transform.origin)) return row("translate", vector_text(transform.origin));
  return row("matrix", matrix_text(transform));
}

bool is_bare(const std::string& key) {
  const auto is_plain = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_';
  };
  return !key.empty() && std::all_of(key.begin(), key.end(), is_plain);
}

fs::path relative_path(const fs::path& path, const fs::path& directory) {
  std::error_code error;
  const fs::path relative = fs::relative(path, directory.empty() ? fs::path(".") : directory, error);
  if (!error && !relative.empty()) return relative;
  const fs::path lexical = path.lexically_relative(directory);
  return lexical.empty() ? path : lexical;
}

std::string settings_text(const std::vector<SceneSetting>& settings) {
  std::string text;
  for (const SceneSetting& setting : settings) {
    const std::string key = is_bare(setting.name) ? setting.name : quoted(setting.name);
    if (setting.values.size() == 1) {
      text += row(key, quoted(setting.values[0]));
      continue;
    }
    std::string list;
    for (const std::string& value : setting.values) list += (list.empty() ? "" : ", ") + quoted(value);
    text += row(key, "[" + list + "]");
  }
  return text;
}

std::string model_text(const SceneModel& model, const fs::path& directory) {
  std::string text = "\n[[model]]\n" + row("path", quoted(relative_path(model.path, directory).generic_string()));
  if (model.up) text += row("up", vector_text(*model.up));
  return text + transform_text(model.transform);
}

std::string camera_text(const SceneCamera& camera) {
  std::string text = "\n[[camera]]\n";
  if (!camera.name.empty()) text += row("name", quoted(camera.name));
  if (camera.position) text += row("position", vector_text(*camera.position));
  if (camera.look_at) text += row("look_at", vector_text(*camera.look_at));
  if (camera.up) text += row("up", vector_text(*camera.up));
  return text + settings_text(camera.settings);
}

std::string light_text(const Light& light) {
  constexpr const char* kKinds[] = {"point", "spot", "directional"};
  std::string text = "\n[[light]]\n" + row("kind", quoted(kKinds[static_cast<int>(light.kind)]));
  if (light.kind != Light::Kind::Directional) text += row("position", vector_text(light.position));
  if (light.kind != Light::Kind::Point) text += row("direction", vector_text(light.direction));
  if (light.kind == Light::Kind::Spot) {
    text += row("inner_angle", degrees_of(light.inner_angle)) + row("outer_angle", degrees_of(light.outer_angle));
  }
  text += row("color", color_text(light.color)) + row("intensity", shortest_text(light.intensity));
  if (light.has_falloff) text += row("falloff", quoted("inverse-square"));
  if (std::isfinite(light.range)) text += row("range", shortest_text(light.range));
  return text;
}

std::string ground_text(const SceneGround& ground) {
  std::string text = "\n[ground]\n" + row("color", color_text(ground.color));
  if (ground.height) text += row("height", shortest_text(*ground.height));
  if (ground.radius) text += row("radius", shortest_text(*ground.radius));
  return text;
}

}  // namespace

std::string scene_file_text(const SceneFile& scene, const fs::path& directory) {
  std::string text = "# A scene of FaceMap: facemap render THIS_FILE -o PICTURE\n";
  if (!scene.settings.empty()) text += "\n[settings]\n" + settings_text(scene.settings);
  for (const SceneModel& model : scene.models) text += model_text(model, directory);
  if (scene.ground) text += ground_text(*scene.ground);
  for (const SceneCamera& camera : scene.cameras) text += camera_text(camera);
  for (const Light& light : scene.lights) text += light_text(light);
  return text;
}

void save_scene_file(const SceneFile& scene, const fs::path& path) {
  const std::string text = scene_file_text(scene, path.has_parent_path() ? path.parent_path() : ".");
  write_whole_file(path, text.data(), text.size());
}

}  // namespace facemap
