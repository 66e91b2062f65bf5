#include "facemap_bench_cases.h"

#include <facemap/error.h>
#include <facemap/generators.h>
#include <facemap/turntable.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <utility>

#include "facemap_bench_clock.h"

namespace facemap::bench {
namespace {

constexpr double kPi = 3.14159265358979323846;
constexpr int kStepsOfATurn = 72;  // of 5 degrees each

/// A mesh that is not yet a scene, and the view and lights it comes with; without lights both are made up.
struct Model {
  Mesh mesh;
  View view;
  std::vector<Light> lights;
};

std::filesystem::path models_folder() {
  const char* folder = std::getenv("FACEMAP_MODELS");
  return folder ? folder : FACEMAP_SOURCE_DIR "/../shared/models";
}

std::filesystem::path model_file(const std::string& name) {
  return models_folder() / "scenes" / name / (name == "nefertiti" ? "nefertiti-lowres.obj" : name + ".obj");
}

Model read_model(const std::filesystem::path& path) {
  Mesh mesh = OBJ::load(path).mesh();
  mesh.triangle_materials.clear();  // nothing is shaded
  return {std::move(mesh), View(), {}};
}

Model generate_model(const std::string& name) {
  const std::size_t at = name.find('@');
  const int detail = at == std::string::npos ? 1 : std::atoi(name.c_str() + at + 1);
  GeneratedScene made = generate_scene(name.substr(0, at), detail);
  Model model{std::move(made.mesh), View(), {}};
  model.view = {made.camera_position, made.look_at, made.up, made.field_angle_deg * kPi / 180, ProjectionKind::Plane};
  for (const auto& light : made.lights) {
    model.lights.push_back({light.position, {light.color.r, light.color.g, light.color.b}, light.intensity});
  }
  return model;
}

/// Millimetres; the floor is at 0, the ceiling at 2,100. The camera sees the bed from the corner at the windows.
Model make_hotel_room() {
  Model model = read_model(model_file("hotel_room"));
  model.view.position = Vector(9200, 1500, -9800);
  model.view.look_at = Vector(11500, 500, -7000);
  model.view.field_angle = 70 * kPi / 180;
  for (const Vector& position : {Vector(9500, 1900, -7000), Vector(11500, 1700, -7500), Vector(10500, 1500, -9500)}) {
    model.lights.push_back({position, {1, 1, 1}, 0.4f});
  }
  return model;
}

/// A square of the board is 1 wide, its top is at about 0; the lights stand on a ring among the pieces.
Model make_low_lights() {
  Model model = generate_model("chessboard");
  model.lights.clear();
  for (const auto& [x, z] : {std::pair(2.77f, 1.15f),
                             {1.15f, 2.77f},
                             {-1.15f, 2.77f},
                             {-2.77f, 1.15f},
                             {-2.77f, -1.15f},
                             {-1.15f, -2.77f},
                             {1.15f, -2.77f},
                             {2.77f, -1.15f}}) {
    model.lights.push_back({Vector(x, 1, z), {1, 1, 1}, 0.25f});
  }
  return model;
}

Model make_model(const std::string& name) {
  const std::vector<std::string> generated = generator_names();
  if (name == "rooms/hotel_room") return make_hotel_room();
  if (name == "rooms/chessboard") return make_low_lights();
  if (std::count(generated.begin(), generated.end(), name.substr(0, name.find('@')))) return generate_model(name);
  if (name.starts_with("models/")) return read_model(model_file(name.substr(7)));
  return read_model(name);
}

/// The rule of make_up_lights with any number of lights: two rings about the scene.
std::vector<Light> make_rings(const Scene& scene, int count) {
  std::vector<Light> lights;
  const DVector c = scene.centre();
  const double r = scene.bounding_radius();
  for (int k = 0; k < count; ++k) {
    const double a = 2 * kPi * k / count;
    const DVector offset(1.6 * std::cos(a), 1 + 0.3 * (k % 2), 1.6 * std::sin(a));
    lights.push_back({Vector(c + r * offset), {1, 1, 1}, 2.0f / static_cast<float>(count)});
  }
  return lights;
}

}  // namespace

std::vector<std::string> default_case_names() {
  std::vector<std::string> names = generator_names();
  for (const char* model : {"chessboard", "copperBeech", "nefertiti"}) {
    if (std::filesystem::exists(model_file(model))) names.push_back(std::string("models/") + model);
  }
  return names;
}

Case make_case(const std::string& name, const Options& options) {
  Model model = make_model(name);
  model.mesh.positions.reserve(model.mesh.positions.size() + 2);  // Embree reads 16 bytes of the last one
  const Stopwatch watch(options.cpu_time ? Time::Process : Time::Wall);
  Scene scene(std::move(model.mesh), {}, options.threads);
  const double ms = watch.milliseconds();

  View view = model.view;
  view.projection = options.projection;
  if (model.lights.empty()) {
    view = make_up_view(scene, view);
    model.lights = make_up_lights(scene);
  }
  const auto wanted = static_cast<std::size_t>(options.lights);
  if (wanted > model.lights.size()) {
    model.lights = make_rings(scene, options.lights);
  } else if (wanted) {
    model.lights.resize(wanted);
  }
  return {name, std::move(scene), ms, view, turntable(view, kStepsOfATurn)[1], std::move(model.lights)};
}

}  // namespace facemap::bench
