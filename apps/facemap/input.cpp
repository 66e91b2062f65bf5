#include "input.h"

#include <facemap/error.h>
#include <facemap/studio.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "scene_words.h"
#include "studio_words.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

constexpr const char* kStandardInput = "standard input";
constexpr double kLargestRadius = 1e37;  ///< a camera some radii away still has float32 coordinates
constexpr std::size_t kHead = 4096;      ///< bytes that tell what a file is

std::string head_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(kHead, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(std::max<std::streamsize>(file.gcount(), 0)));
  return head;
}

/// A pipe can be read only once: its name has to say that it is a scene.
bool names_scene(const fs::path& path) {
  std::error_code ignored;
  if (!path.extension().empty()) return is_scene_file("", path.extension());
  return fs::is_regular_file(path, ignored) && is_scene_file(head_of(path), path.extension());
}

Affine scaled(const Affine& transform, double factor) {
  return factor == 1 ? transform : Affine::scaling(DVector(factor)) * transform;
}

Vector scene_up(const RenderArguments& arguments, const std::optional<Vector>& stated) {
  return arguments.frames.ups.empty() ? stated.value_or(Vector(0, 1, 0)) : arguments.frames.ups[0];
}

/// The up of a scene's settings is the world's, even where a pose takes its place for the camera.
std::optional<Vector> stated_up(const Input& input, const std::optional<Vector>& of_model) {
  for (const Word& word : input.settings) {
    if (word.name == "up") return parse_direction(word.text);
  }
  return of_model;
}

/// A model that no option changes is read the quickest way.
bool is_plain(const Input& input, const RenderArguments& arguments) {
  return input.bytes.empty() && input.scene.models.size() == 1 && !input.scene.models[0].up &&
         input.scene.models[0].transform == Affine() && arguments.scale == 1 && !wants_ground(input, arguments) &&
         !arguments.studio;
}

Model load_model_of(const Input& input, const RenderArguments& arguments) {
  if (!input.bytes.empty()) {
    return transformed(parse_model(input.bytes, kStandardInput, {}, arguments.limits),
                       scaled(Affine(), arguments.scale));
  }
  std::vector<SceneModel> models = input.scene.models;
  for (SceneModel& model : models) model.transform = scaled(model.transform, arguments.scale);
  return load_models(models, scene_up(arguments, stated_up(input, std::nullopt)), arguments.limits);
}

}  // namespace

bool is_standard_input(const fs::path& path) { return path == "-"; }

std::string read_standard_input(std::uint64_t max_bytes) {
  constexpr std::size_t kStep = std::size_t{1} << 16;
  std::string bytes;
  while (true) {
    const std::size_t size = bytes.size();
    bytes.resize(size + kStep);
    const ::ssize_t got = ::read(STDIN_FILENO, bytes.data() + size, kStep);
    if (got < 0 && errno != EINTR)
      throw LoadError(LoadError::Cause::CannotOpen, kStandardInput, 0, std::strerror(errno));
    bytes.resize(size + static_cast<std::size_t>(std::max<::ssize_t>(got, 0)));
    if (bytes.size() > max_bytes) {
      throw LoadError(LoadError::Cause::TooLarge, kStandardInput, 0,
                      "more than " + std::to_string(max_bytes) + " bytes");
    }
    if (got == 0) return bytes;
  }
}

Input read_input(const fs::path& path, const ModelLimits& limits) {
  Input input;
  if (is_standard_input(path)) {
    input.bytes = read_standard_input(limits.max_bytes);
    if (input.bytes.empty()) throw LoadError(LoadError::Cause::UnknownFormat, kStandardInput, 0, "is empty");
    input.is_scene = is_scene_file(input.bytes);
    if (input.is_scene) input.scene = parse_scene_file(std::exchange(input.bytes, ""), kStandardInput, ".", limits);
  } else {
    input.is_scene = names_scene(path);
    if (input.is_scene) input.scene = load_scene_file(path, limits);
  }
  if (input.is_scene) {
    input.settings = setting_words(input.scene, is_standard_input(path) ? fs::path(kStandardInput) : path);
  } else {
    input.scene.models = {{path, std::nullopt, Affine()}};
  }
  return input;
}

bool wants_ground(const Input& input, const RenderArguments& arguments) {
  return arguments.ground ? !arguments.ground->is_none : input.scene.ground.has_value();
}

Loaded load(const Input& input, const Words& words) {
  RenderArguments arguments = arguments_of(words);
  if (is_plain(input, arguments)) {
    Loaded loaded{Scene::load(input.scene.models[0].path, arguments.limits), {}, {0, 1, 0}, words};
    loaded.ball = {loaded.scene.centre(), loaded.scene.bounding_radius()};
    loaded.up = scene_up(arguments, stated_up(input, loaded.scene.up()));
    return loaded;
  }
  Model model = load_model_of(input, arguments);
  const Vector up = scene_up(arguments, stated_up(input, model.up));
  const BoundingBall ball = bounding_ball(model.mesh);
  Words all = words;
  if (arguments.studio && !input.is_scene) {
    if (!(ball.radius <= kLargestRadius))
      throw Error(arguments.model.string() + ": its coordinates are too large for a view to be made up");
    all =
        merge(words, studio_words(make_studio(model.mesh, up, arguments.size().width, arguments.size().height), words));
    arguments = arguments_of(all);
  }
  if (wants_ground(input, arguments)) {
    SceneGround ground = input.scene.ground.value_or(SceneGround());
    if (arguments.ground && arguments.ground->color) ground.color = *arguments.ground->color;
    append(model, make_ground(ground, model, up));
  }
  return {Scene(std::move(model), arguments.limits.threads), ball, up, all};
}

}  // namespace facemap::program
