#pragma once

#include <facemap/affine.h>
#include <facemap/color.h>
#include <facemap/light.h>
#include <facemap/model.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace facemap {

/// A key of a scene file that the library does not know, such as an option of the program. Its value is text as one
/// would write it on a command line: 0.5, on, 1,2,3; an array of texts or of arrays has several.
struct SceneSetting {
  std::string name;  ///< with - for _
  std::vector<std::string> values;
  std::int64_t line = 0, column = 0;  ///< where it stands, from 1; 0: not in a file

  bool operator==(const SceneSetting& other) const = default;
};

/// A model that a scene names, and where it stands.
struct SceneModel {
  std::filesystem::path path;  ///< as it can be opened from the working directory
  std::optional<Vector> up;    ///< the model's own up, which is turned to the scene's before the transform
  Affine transform;

  bool operator==(const SceneModel& other) const = default;
};

struct SceneCamera {
  std::string name;
  std::optional<Vector> position, look_at, up;
  std::vector<SceneSetting> settings;  ///< what else is said of it: its lens
};

/// A level floor for shadows to fall on.
struct SceneGround {
  Color color{0.6f, 0.6f, 0.6f};  ///< linear
  std::optional<double> height;   ///< along the scene's up, world units; none: just below the models
  std::optional<double> radius;   ///< world units; none: reaches far beyond the models
};

/// A picture's description: what a TOML file of scene says (docs/scene-file.md).
struct SceneFile {
  std::vector<SceneModel> models;
  std::vector<SceneCamera> cameras;
  std::vector<Light> lights;
  std::optional<SceneGround> ground;
  std::vector<SceneSetting> settings;
};

/// Whether bytes are a scene file rather than a model: by the file's extension, or if it says nothing by a first line
/// of TOML.
bool is_scene_file(std::string_view bytes, const std::filesystem::path& extension = {});

/// Reads a scene file; no model is opened. Models lie in the scene's folder or its folders unless
/// `limits.allow_outside`. Throws LoadError with line and column.
SceneFile load_scene_file(const std::filesystem::path& path, const ModelLimits& limits = {});

/// The same of text in memory: `name` stands in messages for the file, models are looked up in `directory`.
SceneFile parse_scene_file(std::string_view text, const std::string& name, const std::filesystem::path& directory,
                           const ModelLimits& limits = {});

/// The scene as TOML text that reads back as the same values; models' paths are written relative to `directory`.
std::string scene_file_text(const SceneFile& scene, const std::filesystem::path& directory);

/// Writes it, whole or not at all. Throws Error.
void save_scene_file(const SceneFile& scene, const std::filesystem::path& path);

/// Reads the models of a scene and puts them together, each at its place; `up` is the scene's. The sum of their faces
/// and bytes is limited. Throws LoadError, or Error where a transform makes no sense.
Model load_models(const std::vector<SceneModel>& models, const Vector& up, const ModelLimits& limits = {});

/// The floor as a model: a disc of one material. By default it lies a 4096th of the models' bounding radius below
/// their lowest point along `up`, and reaches 24 radii far. Throws Error if `up` has no direction or a value is not
/// finite.
Model make_ground(const SceneGround& ground, const Model& models, const Vector& up);

}  // namespace facemap
