#include <facemap/scene_file.h>
#include <facemap/space_vector.h>

#include <algorithm>
#include <optional>
#include <utility>

#include "scene/file_mapping.h"
#include "scene/scene_numbers.h"
#include "scene/toml_file.h"
#include "scene/uri.h"
#include "simd/floating_point_mode.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;
namespace fs = std::filesystem;

constexpr std::uint64_t kMostBytes = std::uint64_t{1} << 24;  ///< of a scene file: a hundred thousand lights

bool is_finite(const Vector& v) { return (v.x - v.x) + (v.y - v.y) + (v.z - v.z) == 0; }

/// Reads the tables of a scene, each by the keys that docs/scene-file.md lists.
class SceneReader {
 public:
  SceneReader(const TomlFile& file, fs::path directory, bool allow_outside)
      : file_(file), directory_(std::move(directory)), allow_outside_(allow_outside) {}

  SceneFile read() const {
    const toml::table& root = file_.root();
    file_.check_keys(root, "a scene", {"model", "camera", "light", "ground", "settings"});
    SceneFile scene;
    for (const toml::table* const table : file_.tables(root, "model")) scene.models.push_back(read_model(*table));
    for (const toml::table* const table : file_.tables(root, "camera")) scene.cameras.push_back(read_camera(*table));
    for (const toml::table* const table : file_.tables(root, "light")) scene.lights.push_back(read_light(*table));
    if (const toml::node* const ground = root.get("ground")) scene.ground = read_ground(*ground);
    if (const toml::node* const settings = root.get("settings")) scene.settings = read_settings(*settings);
    if (scene.models.empty()) file_.fail(root, Cause::NoFaces, "no model: a scene needs a table [[model]] with a path");
    return scene;
  }

 private:
  const toml::node& needed(const toml::table& table, const char* key, const char* what) const {
    const toml::node* const node = table.get(key);
    if (node == nullptr) file_.fail(table, Cause::BadValue, std::string(what) + " has no " + key);
    return *node;
  }

  SceneModel read_model(const toml::table& table) const {
    file_.check_keys(table, "[[model]]", {"path", "up", "scale", "rotate", "translate", "matrix"});
    SceneModel model;
    model.path = find_model(needed(table, "path", "[[model]]"));
    if (const toml::node* const up = table.get("up")) model.up = file_.direction(*up);
    model.transform = read_transform(table);
    for (const DVector& column : {model.transform.x, model.transform.y, model.transform.z, model.transform.origin}) {
      if (glm::dot(column, DVector(0)) != 0) file_.fail(table, Cause::BadNumber, "[[model]]'s transform is too large");
    }
    if (glm::dot(glm::cross(model.transform.x, model.transform.y), model.transform.z) == 0)
      file_.fail(table.contains("matrix") ? *table.get("matrix") : table, Cause::BadValue,
                 "[[model]]'s transform flattens the model");
    return model;
  }

  fs::path find_model(const toml::node& node) const {
    const std::string name = file_.text(node);
    if (name.empty()) file_.fail(node, Cause::BadValue, "is empty");
    if (name.find('\0') != std::string::npos) file_.fail(node, Cause::BadValue, "has a NUL byte");
    if (!allow_outside_) {
      std::string uri;  // a name, not an address: its percent signs stand for themselves
      for (const char c : name) uri += c == '%' ? std::string("%25") : std::string(1, c);
      const UriResult<fs::path> found = file_inside(directory_, uri);
      if (found.leads_out) {
        file_.fail(node, Cause::NotAllowed,
                   "\"" + name +
                       "\": models outside the scene's folder are not opened unless "
                       "that is allowed (--allow-outside)");
      }
      if (!found.value) file_.fail(node, Cause::CannotOpen, "\"" + name + "\": " + found.reason);
    }
    return directory_ == "." ? fs::path(name) : directory_ / name;
  }

  Affine read_transform(const toml::table& table) const {
    const toml::node* const matrix = table.get("matrix");
    Affine transform;
    if (const toml::node* const scale = table.get("scale")) transform = Affine::scaling(read_scale(*scale));
    if (const toml::node* const rotate = table.get("rotate")) transform = read_rotations(*rotate) * transform;
    if (const toml::node* const translate = table.get("translate"))
      transform = Affine::translation(file_.wide_vector(*translate)) * transform;
    if (matrix == nullptr) return transform;
    if (table.contains("scale") || table.contains("rotate") || table.contains("translate"))
      file_.fail(*matrix, Cause::BadValue, "a matrix is all of the transform: no scale, rotate or translate beside it");
    return read_matrix(*matrix);
  }

  DVector read_scale(const toml::node& node) const {
    const DVector factors = node.is_array() ? file_.wide_vector(node) : DVector(file_.number(node));
    if (factors.x * factors.y * factors.z == 0) file_.fail(node, Cause::BadValue, "a scale of 0 flattens the model");
    return factors;
  }

  /// One rotation, or an array of them, the first first.
  Affine read_rotations(const toml::node& node) const {
    if (node.is_table()) return read_rotation(*node.as_table());
    if (!node.is_array()) file_.fail(node, Cause::BadValue, "is not a table { axis = ..., degrees = ... }");
    Affine all;
    for (const toml::node& element : *node.as_array()) {
      if (!element.is_table()) file_.fail(element, Cause::BadValue, "is not a table { axis = ..., degrees = ... }");
      all = read_rotation(*element.as_table()) * all;
    }
    return all;
  }

  Affine read_rotation(const toml::table& table) const {
    file_.check_keys(table, "rotate", {"axis", "degrees"});
    const Vector axis = file_.direction(needed(table, "axis", "rotate"));
    const toml::node& degrees = needed(table, "degrees", "rotate");
    try {
      return Affine::rotation(DVector(axis), file_.number(degrees));
    } catch (const LoadError&) {
      throw;
    } catch (const Error& error) {
      file_.fail(degrees, Cause::BadValue, error.what());
    }
  }

  /// Four rows of four numbers, applied to columns; the last row is 0, 0, 0, 1.
  Affine read_matrix(const toml::node& node) const {
    const toml::array* const rows = node.as_array();
    if (rows == nullptr || rows->size() != 4)
      file_.fail(node, Cause::BadValue, "is not an array of 4 rows of 4 numbers");
    std::vector<double> m[4];
    for (std::size_t i = 0; i < 4; ++i) m[i] = file_.numbers((*rows)[i], 4);
    if (m[3] != std::vector<double>{0, 0, 0, 1})
      file_.fail((*rows)[3], Cause::BadValue, "the last row is not 0, 0, 0, 1: the matrix is not affine");
    return {{m[0][0], m[1][0], m[2][0]},
            {m[0][1], m[1][1], m[2][1]},
            {m[0][2], m[1][2], m[2][2]},
            {m[0][3], m[1][3], m[2][3]}};
  }

  SceneCamera read_camera(const toml::table& table) const {
    SceneCamera camera;
    for (const auto& [key, node] : table) {
      const std::string name = setting_name(key);
      if (name == "name") {
        camera.name = file_.text(node);
      } else if (name == "position") {
        camera.position = file_.vector(node);
      } else if (name == "look-at") {
        camera.look_at = file_.vector(node);
      } else if (name == "up") {
        camera.up = file_.direction(node);
      } else {
        file_.add_setting(camera.settings, key, node);
      }
    }
    check_sight(table, camera);
    return camera;
  }

  void check_sight(const toml::table& table, const SceneCamera& camera) const {
    if (!camera.position || !camera.look_at) return;
    if (camera.position == camera.look_at)
      file_.fail(table, Cause::BadValue, "[[camera]] stands at the point that it looks at");
    if (!camera.up) return;
    try {
      SpaceVector::looking_at(*camera.position, *camera.look_at, *camera.up);
    } catch (const Error& error) {
      file_.fail(table, Cause::BadValue, std::string("[[camera]]: ") + error.what());
    }
  }

  Light read_light(const toml::table& table) const {
    file_.check_keys(table, "[[light]]",
                     {"kind", "position", "direction", "look_at", "inner_angle", "outer_angle", "color", "intensity",
                      "falloff", "range"});
    Light light;
    if (const toml::node* const kind = table.get("kind"))
      light.kind = static_cast<Light::Kind>(file_.choice(*kind, {"point", "spot", "directional"}));
    read_place(table, light);
    if (light.kind == Light::Kind::Spot) read_cone(table, light);
    if (light.kind != Light::Kind::Spot && (table.contains("inner_angle") || table.contains("outer_angle")))
      file_.fail(table, Cause::BadValue, "only a light of kind \"spot\" has angles");
    if (const toml::node* const color = table.get("color")) light.color = read_light_color(*color);
    if (const toml::node* const intensity = table.get("intensity")) {
      light.intensity = file_.real(*intensity);
      if (light.intensity < 0) file_.fail(*intensity, Cause::BadValue, "is below 0");
    }
    if (const toml::node* const falloff = table.get("falloff"))
      light.has_falloff = file_.choice(*falloff, {"constant", "inverse-square"}) == 1;
    if (const toml::node* const range = table.get("range")) light.range = file_.positive(*range);
    return light;
  }

  Color read_light_color(const toml::node& node) const {
    const Color color = file_.color(node);
    if (color.r < 0 || color.g < 0 || color.b < 0) file_.fail(node, Cause::BadValue, "has a value below 0");
    return color;
  }

  void read_place(const toml::table& table, Light& light) const {
    const bool has_place = light.kind != Light::Kind::Directional, has_direction = light.kind != Light::Kind::Point;
    if (has_place) light.position = file_.vector(needed(table, "position", "[[light]]"));
    if (!has_place && table.contains("position"))
      file_.fail(*table.get("position"), Cause::BadValue, "a directional light has no position");
    const toml::node* const direction = table.get("direction");
    const toml::node* const look_at = table.get("look_at");
    if (!has_direction && (direction || look_at))
      file_.fail(direction ? *direction : *look_at, Cause::BadValue, "a point light has no direction");
    if (look_at && (direction || !has_place))
      file_.fail(*look_at, Cause::BadValue,
                 direction ? "stands beside a direction" : "a directional light has no position to look from");
    if (direction) light.direction = file_.direction(*direction);
    if (look_at) light.direction = file_.vector(*look_at) - light.position;
    if (has_direction && !direction && !look_at) file_.fail(table, Cause::BadValue, "[[light]] has no direction");
    if (has_direction &&
        !(glm::dot(DVector(light.direction), DVector(light.direction)) > 0 && is_finite(light.direction)))
      file_.fail(*look_at, Cause::BadValue, "gives no direction from the light's position");
  }

  void read_cone(const toml::table& table, Light& light) const {
    constexpr double kWidest = 180;
    const auto degrees = [&](const char* key, double otherwise) {
      const toml::node* const node = table.get(key);
      if (node == nullptr) return otherwise;
      const double value = file_.number(*node);
      if (!(value >= 0 && value <= kWidest)) file_.fail(*node, Cause::BadValue, "is not an angle of 0 to 180 degrees");
      return radians_of(value);
    };
    light.outer_angle = degrees("outer_angle", light.outer_angle);
    light.inner_angle = degrees("inner_angle", std::min(light.inner_angle, light.outer_angle));
    if (light.inner_angle > light.outer_angle)
      file_.fail(*table.get("inner_angle"), Cause::BadValue, "is wider than outer_angle");
  }

  SceneGround read_ground(const toml::node& node) const {
    if (!node.is_table()) file_.fail(node, Cause::BadValue, "is not a table [ground]");
    const toml::table& table = *node.as_table();
    file_.check_keys(table, "[ground]", {"color", "height", "radius"});
    SceneGround ground;
    if (const toml::node* const color = table.get("color")) ground.color = file_.color(*color);
    if (const toml::node* const height = table.get("height")) ground.height = file_.number(*height);
    if (const toml::node* const radius = table.get("radius")) ground.radius = file_.positive(*radius);
    return ground;
  }

  std::vector<SceneSetting> read_settings(const toml::node& node) const {
    if (!node.is_table()) file_.fail(node, Cause::BadValue, "is not a table [settings]");
    std::vector<SceneSetting> settings;
    for (const auto& [key, value] : *node.as_table()) file_.add_setting(settings, key, value);
    return settings;
  }

  const TomlFile& file_;
  fs::path directory_;
  bool allow_outside_;
};

}  // namespace

SceneFile parse_scene_file(std::string_view text, const std::string& name, const fs::path& directory,
                           const ModelLimits& limits) {
  const FloatingPointMode mode;
  const std::uint64_t most = std::min(limits.max_bytes, kMostBytes);
  if (text.size() > most) throw LoadError(Cause::TooLarge, name, 0, "more than " + std::to_string(most) + " bytes");
  const TomlFile file(text, name);
  return SceneReader(file, directory, limits.allow_outside).read();
}

SceneFile load_scene_file(const fs::path& path, const ModelLimits& limits) {
  const FileMapping file(path, std::min(limits.max_bytes, kMostBytes));
  return parse_scene_file(file.text(), path.string(), path.has_parent_path() ? path.parent_path() : ".", limits);
}

}  // namespace facemap
