#include <facemap/facemap.h>

#include <cstdlib>
#include <iostream>
#include <memory>

#include "commands.h"
#include "exit_codes.h"
#include "frame_writer.h"
#include "light_flags.h"
#include "model.h"
#include "progress_line.h"
#include "render_arguments.h"
#include "stats.h"
#include "stopwatch.h"

namespace facemap::program {
namespace {

std::vector<Light> lights_of(const RenderArguments& arguments, const Scene& scene) {
  std::vector<Light> lights = arguments.lights.empty() ? make_up_lights(scene) : arguments.lights;
  for (Light& light : lights) light.intensity *= arguments.intensity;
  return lights;
}

void say_what_was_made_up(const RenderArguments& arguments, const std::vector<View>& views, const FrameRange& range,
                          const std::vector<Light>& lights) {
  if (arguments.quiet) return;
  const std::vector<WantedView> wanted = arguments.frames.each();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const bool is_made = arguments.frames.turntable > 0 || (range.first <= i && i <= range.last);
    if (is_made && !wanted[i].is_complete()) std::cerr << "facemap: view: " << flags_of(views[i]) << '\n';
  }
  if (arguments.lights.empty()) std::cerr << "facemap: lights: " << flags_of(lights) << '\n';
}

/// What the line says of frame `frame`: the phase, and the frame if there are several.
std::string progress_name(const char* phase, std::size_t frame, std::size_t count) {
  if (count == 1) return phase;
  return std::to_string(frame + 1) + "/" + std::to_string(count) + " " + phase;
}

/// Textures that could not be read: known once a picture wanted them.
void print_warnings(const Renderer::Statistics& statistics, ProgressLine& line) {
  if (statistics.warnings.empty()) return;
  line.clear();
  for (const std::string& warning : statistics.warnings) std::cerr << "facemap: warning: " << warning << '\n';
}

/// One picture after the other: what is made for the lights is made once. Each is written while the next is made.
void render_frames(Renderer& renderer, const std::vector<View>& views, const std::vector<FrameFiles>& files,
                   FrameWriter& writer, int threads, bool shows_progress, Stats& stats) {
  ProgressLine line(shows_progress);
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (i > 0) renderer.set_view(views[i]);
    Image image = renderer.render([&](double fraction, const char* phase) {
      line.show(fraction, progress_name(phase, i, views.size()).c_str());
      return true;
    });
    stats.add_frame(renderer.statistics());
    if (i == 0 && shows_progress) print_warnings(renderer.statistics(), line);
    if (i + 1 < views.size()) {
      writer.begin(std::move(image), files[i]);
    } else {
      line.clear();
      writer.write(image, files[i], threads);
    }
  }
  stats.write_ms = writer.written_ms();
  stats.wait_ms = writer.waited_ms();
}

void render(const RenderArguments& arguments) {
  const std::vector<FrameFiles> files = check_files(arguments);
  Stats stats;
  Stopwatch total, phase;
  const Scene scene = load_model(arguments.model, arguments.quiet, arguments.options.threads);
  stats.load_ms = phase.lap();

  const FrameRange range = arguments.frames.selected();
  const std::vector<View> all_views = complete_views(scene, arguments.frames, arguments.size());
  const std::vector<View> views(all_views.begin() + static_cast<std::ptrdiff_t>(range.first),
                                all_views.begin() + static_cast<std::ptrdiff_t>(range.last) + 1);
  const std::vector<Light> lights = lights_of(arguments, scene);
  say_what_was_made_up(arguments, all_views, range, lights);
  Renderer renderer(scene, views[0], lights, renderer_options(arguments));
  FrameWriter writer(arguments.output.format, arguments.output.layers);
  render_frames(renderer, views, files, writer, arguments.options.threads, !arguments.quiet, stats);

  stats.total_ms = total.lap();
  stats.model = arguments.model.string();
  stats.width = arguments.size().width;
  stats.height = arguments.size().height;
  stats.light_count = lights.size();
  if (arguments.stats == StatsFormat::Json) std::cout << stats_json(stats, scene) << std::flush;
  if (arguments.stats == StatsFormat::Text) std::cout << stats_text(stats, scene) << std::flush;
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
      "A file appears whole or not at all; what stood there stays until the new one is complete.\n"
      "Several pictures in one run (--camera several times, or --turntable) cost less than several runs:\n"
      "what is made for the lights is made once. An interrupt leaves the pictures that are complete.\n";
  command.options = render_options(*arguments);
  command.examples = {
      {"facemap render model.obj -o out.png", "the whole model, seen from above at the right"},
      {"facemap render model.obj -o out.png --camera 3,2,5 --look-at 0,1,0 --projection plane",
       "a perspective view from a place of one's own"},
      {"facemap render model.obj -o out.png --light 4,6,3 --light -5,3,2,0.2,0.2,0.4 --samples edges",
       "a white and a bluish light, smooth outlines"},
      {"facemap render model.obj -o out.png --aov id=id.npy --aov depth=depth.npy",
       "which face each pixel sees, and how far away it is"},
      {"facemap render model.obj -o out.exr --aov z --aov normal --aov albedo --aov object",
       "one EXR file with layers for a compositor"},
      {"facemap render model.obj -o frame_{n}.png --turntable 36", "once around the model in steps of 10 degrees"},
      {"facemap render model.obj -o {model}_{n}.png --turntable 36 --frames 0..8",
       "a quarter of the way: other machines make the rest"},
      {"facemap render model.obj -o view_{n}.png --camera 3,2,5 --camera -3,2,5 --look-at 0,1,0",
       "two places, one point to look at: view_0.png and view_1.png"},
      {"facemap render model.obj -o - --size 256x256 | file -", "a thumbnail for another program"},
  };
  command.run = [arguments] {
    render(*arguments);
    return kDone;
  };
  return command;
}

}  // namespace facemap::program
