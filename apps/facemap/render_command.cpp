#include <facemap/facemap.h>

#include <chrono>
#include <filesystem>
#include <iostream>
#include <memory>

#include "commands.h"
#include "interrupt.h"
#include "model.h"
#include "output.h"
#include "progress_line.h"
#include "stats_json.h"
#include "text_values.h"
#include "usage_error.h"
#include "view_flags.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

/// Where the planes go; empty: not wanted.
struct PlaneFiles {
  fs::path ids, depths, lights;
};

struct RenderArguments {
  fs::path model, output;
  Size size;
  WantedView view;
  std::vector<Light> lights;
  float intensity = 1;
  Samples samples;
  Renderer::Options options;
  PlaneFiles planes;
  bool wants_stats = false;
  bool quiet = false;
};

/// Milliseconds since it was made or last asked.
class Stopwatch {
 public:
  double lap() {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - start_).count();
    start_ = now;
    return ms;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

void add_plane(PlaneFiles& planes, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals + 1 == text.size()) throw UsageError("'" + text + "' is not NAME=FILE");
  fs::path* const files[] = {&planes.ids, &planes.depths, &planes.lights};
  fs::path& file = *files[parse_choice(text.substr(0, equals), {"id", "depth", "lights"})];
  if (!file.empty()) throw UsageError(text.substr(0, equals) + " is given more than once");
  file = text.substr(equals + 1);
}

void check(const RenderArguments& arguments) {
  if (arguments.model.empty()) throw UsageError("no model is given");
  check_png_output(arguments.output, arguments.model);
  if (is_standard_output(arguments.output) && arguments.wants_stats) {
    throw UsageError("-o - and --stats json would both write to standard output");
  }
  std::vector<fs::path> files{arguments.output};
  for (const fs::path& file : {arguments.planes.ids, arguments.planes.depths, arguments.planes.lights}) {
    if (file.empty()) continue;
    check_output(file, arguments.model);
    for (const fs::path& other : files) {
      if (other.lexically_normal() == file.lexically_normal())
        throw UsageError(file.string() + ": two outputs name this file");
    }
    files.push_back(file);
  }
}

Renderer::Options options_of(const RenderArguments& arguments) {
  Renderer::Options options = arguments.options;
  options.width = arguments.size.width;
  options.height = arguments.size.height;
  options.sampling = arguments.samples.sampling;
  options.samples = arguments.samples.side;
  options.want_ids = !arguments.planes.ids.empty();
  options.want_depths = !arguments.planes.depths.empty();
  options.want_lights = !arguments.planes.lights.empty();
  return options;
}

std::vector<Light> lights_of(const RenderArguments& arguments, const Scene& scene) {
  std::vector<Light> lights = arguments.lights.empty() ? make_up_lights(scene) : arguments.lights;
  for (Light& light : lights) light.intensity *= arguments.intensity;
  return lights;
}

void say_what_was_made_up(const RenderArguments& arguments, const View& view, const std::vector<Light>& lights) {
  if (arguments.quiet) return;
  if (!arguments.view.is_complete()) std::cerr << "facemap: view: " << flags_of(view) << '\n';
  if (arguments.lights.empty()) std::cerr << "facemap: lights: " << flags_of(lights) << '\n';
}

void write_outputs(const RenderArguments& arguments, const Image& image) {
  const PlaneFiles& planes = arguments.planes;
  if (is_standard_output(arguments.output)) {
    write_to_standard_output(encode_png(image));
  } else {
    write_whole([&] { write_png(image, arguments.output); });
  }
  if (!planes.ids.empty()) write_whole([&] { write_ids_npy(image, planes.ids); });
  if (!planes.depths.empty()) write_whole([&] { write_depths_npy(image, planes.depths); });
  if (!planes.lights.empty()) write_whole([&] { write_lights_npy(image, planes.lights); });
}

void render(const RenderArguments& arguments) {
  check(arguments);
  Stopwatch total, phase;
  const Scene scene = load_model(arguments.model, arguments.quiet);
  RunFacts facts;
  facts.load_ms = phase.lap();

  const View view = complete_view(scene, arguments.view);
  const std::vector<Light> lights = lights_of(arguments, scene);
  say_what_was_made_up(arguments, view, lights);
  Renderer renderer(scene, view, lights, options_of(arguments));
  ProgressLine line(!arguments.quiet);
  const Image image = renderer.render([&line](double fraction, const char* name) {
    line.show(fraction, name);
    return true;
  });
  line.clear();

  phase.lap();
  write_outputs(arguments, image);
  facts.write_ms = phase.lap();
  facts.total_ms = total.lap();
  facts.model = arguments.model.string();
  facts.width = image.width;
  facts.height = image.height;
  facts.light_count = lights.size();
  if (arguments.wants_stats) std::cout << stats_json(facts, scene, renderer.statistics()) << std::flush;
}

std::vector<Option> render_options(RenderArguments& a) {
  const auto path = [](const std::string& text) { return fs::path(text); };
  const auto choice = [](auto& field, std::vector<std::string> choices) {
    return [&field, choices](const std::string& text) {
      field = static_cast<std::decay_t<decltype(field)>>(parse_choice(text, choices));
    };
  };
  const auto on_off = [](const std::string& text) { return parse_choice(text, {"off", "on"}) == 1; };
  return {
      {"MODEL", "", "", "the model: a Wavefront OBJ file", into(a.model, path)},
      {"-o,--output", "FILE", "", "the picture: PNG, 8-bit sRGB; - writes it to standard output", into(a.output, path)},
      {"--size", "WxH", "1024x1024", "width and height in pixels", into(a.size, parse_size)},

      {"--camera", "X,Y,Z", "made up", "where the camera stands", into(a.view.camera, parse_vector)},
      {"--look-at", "X,Y,Z", "made up", "the point in the middle of the picture", into(a.view.look_at, parse_vector)},
      {"--up", "X,Y,Z", "0,1,0", "the direction that points up in the picture", into(a.view.up, parse_vector)},
      {"--field-angle", "DEG", "50",
       "the field of view in degrees: across the shorter side (surface, up to 360) or from bottom to top (plane, "
       "below 180)",
       into(a.view.field_angle, parse_degrees)},
      {"--projection", "KIND", "surface",
       "surface: the paper's, distance from the middle is proportional to the angle; plane: perspective, straight "
       "lines stay straight",
       choice(a.view.projection, {"surface", "plane"})},

      {"--light", "X,Y,Z[,R,G,B]", "eight made up",
       "a point light and its linear colour, 1,1,1 if left out; once a light",
       [&a](const std::string& text) { a.lights.push_back(parse_light(text)); }, true},
      {"--intensity", "FACTOR", "1", "multiplies the colour of every light", into(a.intensity, parse_number)},
      {"--falloff", "KIND", "constant", "how light fades with distance: constant or inverse-square",
       choice(a.options.falloff, {"constant", "inverse-square"})},
      {"--background", "COLOR", "0,0,0", "where no face is: linear r,g,b or sRGB #rrggbb",
       into(a.options.background, parse_color)},

      {"--samples", "N", "1",
       "rays a pixel: 1; a grid such as 4x4; edges for one ray and 4x4 where a pixel may hold an edge (edges:8 for "
       "8x8)",
       into(a.samples, parse_samples)},
      {"--normals", "KIND", "smooth", "smooth (where the file has normals or smoothing groups) or flat",
       choice(a.options.normals, {"flat", "smooth"})},
      {"--terminator-fix", "on|off", "on", "keeps coarse smooth surfaces from shadowing themselves in facets",
       into(a.options.shadow_terminator_fix, on_off)},
      {"--builder", "KIND", "cover",
       "how maps are filled: cover is exact; fill is as published and can miss a face at its edge",
       choice(a.options.builder, {"cover", "fill"})},

      {"--aov", "NAME=FILE", "",
       "writes a plane as a NumPy .npy file: id (int32, -1 for none), depth (float32, along the ray, inf for none), "
       "lights (uint8, one bit a light, 1 is lit); once a plane",
       [&a](const std::string& text) { add_plane(a.planes, text); }, true},
      {"--stats", "json", "", "prints times, memory and counts as JSON on standard output",
       [&a](const std::string& text) { a.wants_stats = parse_choice(text, {"json"}) == 0; }},
      {"-q,--quiet", "", "", "no warnings, no made-up flags, no progress",
       [&a](const std::string&) { a.quiet = true; }},
  };
}

}  // namespace

Command render_command() {
  const auto arguments = std::make_shared<RenderArguments>();
  Command command;
  command.name = "render";
  command.summary = "Draw a model with exact shadows of point lights";
  command.text =
      "What is not said is made up: a view that holds the whole model, eight lights around it. Both are\n"
      "printed on standard error as flags, to be copied and changed. +y is up; angles are in degrees.\n"
      "A file appears whole or not at all; what stood there stays until the new one is complete.\n";
  command.options = render_options(*arguments);
  command.examples = {
      {"facemap render model.obj -o out.png", "the whole model, seen from above at the right"},
      {"facemap render model.obj -o out.png --camera 3,2,5 --look-at 0,1,0 --projection plane",
       "a perspective view from a place of one's own"},
      {"facemap render model.obj -o out.png --light 4,6,3 --light -5,3,2,0.2,0.2,0.4 --samples edges",
       "a white and a bluish light, smooth outlines"},
      {"facemap render model.obj -o out.png --aov id=id.npy --aov depth=depth.npy",
       "which face each pixel sees, and how far away it is"},
      {"facemap render model.obj -o - --size 256x256 | file -", "a thumbnail for another program"},
  };
  command.run = [arguments] { render(*arguments); };
  return command;
}

}  // namespace facemap::program
