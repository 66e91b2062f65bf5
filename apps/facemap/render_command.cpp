#include <facemap/facemap.h>

#include <algorithm>
#include <iostream>
#include <memory>

#include "commands.h"
#include "default_output.h"
#include "exit_codes.h"
#include "file_views.h"
#include "frame_writer.h"
#include "input.h"
#include "input_files.h"
#include "light_flags.h"
#include "output.h"
#include "progress_line.h"
#include "render_arguments.h"
#include "report.h"
#include "save_scene.h"
#include "stats.h"
#include "stopwatch.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

void say_what_was_made_up(const std::vector<WantedView>& wanted, const std::vector<View>& views,
                          const FrameRange& range, const WantedLights& lights) {
  const bool is_turned = views.size() != wanted.size();
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const bool is_made = is_turned || (range.first <= i && i <= range.last);
    if (is_made && !wanted[i].is_complete()) note("view: " + flags_of(views[i]));
  }
  if (lights.are_made_up) note("lights: " + flags_of(lights.lights));
}

/// The file's name, or the pattern where a name of its own would not do.
std::string shown_output(const fs::path& pattern, const std::vector<FrameFiles>& files) {
  const std::string name = files[0].picture.string();
  return files.size() == 1 && name.find('{') == std::string::npos ? name : pattern.string();
}

/// The command that makes a picture of the studio again, by flags alone.
void say_studio_command(const RenderArguments& arguments, const std::string& output, const Words& words) {
  Words flags;
  for (const Word& word : words) {
    if (word.name != "MODEL" && word.name != "output" && word.name != "studio" && word.name != "save-scene")
      flags.push_back(word);
  }
  note("the same again: facemap render " + quoted_for_shell(arguments.model.string()) + " -o " +
       quoted_for_shell(output) + " " + flags_of(flags));
}

void say_what_is_odd(const Scene& scene, const fs::path& model) {
  for (const std::string& warning : scene.report().warnings) warn(warning);
  if (scene.kept_faces().empty()) warn(model.string() + ": no face has an area");
}

std::string milliseconds(double ms) { return std::to_string(static_cast<long long>(ms + 0.5)) + " ms"; }

void say_what_was_read(const Scene& scene, const RenderArguments& arguments, double load_ms) {
  note_verbose("read " + arguments.model.string() + " in " + milliseconds(load_ms) + ": " +
               std::to_string(scene.face_count()) + " triangles, " + std::to_string(scene.kept_faces().size()) +
               " of them drawn, " + std::to_string(scene.materials().size()) + " materials, " +
               std::to_string(scene.images().size()) + " textures, " + std::to_string(scene.lights().size()) +
               " lights, " + std::to_string(scene.cameras().size()) + " cameras");
}

void say_what_was_drawn(const Renderer::Statistics& statistics) {
  note_verbose("drawn: camera " + milliseconds(statistics.camera_map_ms) + ", lights " +
               milliseconds(statistics.light_maps_ms) + ", shading " + milliseconds(statistics.shade_ms) + "; " +
               statistics.reason + "; " + statistics.target + ", " + std::to_string(statistics.threads) + " threads");
}

/// Textures that could not be read: known once a picture wanted them.
void print_warnings(const Renderer::Statistics& statistics, ProgressLine& line) {
  if (statistics.warnings.empty()) return;
  line.clear();
  for (const std::string& warning : statistics.warnings) warn(warning);
}

/// One picture after the other: what is made for the lights is made once. Each is written while the next is made.
void render_frames(Renderer& renderer, const std::vector<View>& views, const std::vector<FrameFiles>& files,
                   FrameWriter& writer, int threads, Stats& stats) {
  ProgressLine line(views.size());
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (i > 0) renderer.set_view(views[i]);
    Image image = renderer.render([&](double fraction, const char* phase) {
      line.show(fraction, phase, i);
      return true;
    });
    stats.add_frame(renderer.statistics());
    if (i == 0) print_warnings(renderer.statistics(), line);
    if (report_style().verbose) {
      line.clear();
      say_what_was_drawn(renderer.statistics());
    }
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

void print_stats(const Stats& stats, StatsFormat format, const Scene& scene) {
  if (format == StatsFormat::Json) std::cout << stats_json(stats, scene) << std::flush;
  if (format == StatsFormat::Text) std::cout << stats_text(stats, scene) << std::flush;
}

/// Reads and loads; a file that is too large is told with the flag that would allow it.
template <typename Read>
auto within_limits(const Read& read) {
  try {
    return read();
  } catch (const LoadError& error) {
    if (error.cause() != LoadError::Cause::TooLarge) throw;
    const bool are_bytes = error.reason().find("bytes") != std::string::npos;
    throw Error(std::string(error.what()) + " (" + (are_bytes ? "--max-bytes" : "--max-faces") + " sets the limit)");
  }
}

RenderArguments checked(const Words& words) {
  RenderArguments arguments = arguments_of(words);
  set_report_style({arguments.quiet, arguments.verbose, arguments.log_json});
  check_limits(arguments);
  return arguments;
}

/// The words of the command line, with a name for the studio's picture if they give none.
Words with_output(Words given, const RenderArguments& asked) {
  if (asked.studio && asked.output.files.picture.empty() && !asked.model.empty())
    given.push_back({"output", default_output(asked.model), ""});
  return given;
}

/// How many pictures there are, as far as flags say it: the file may have cameras.
std::size_t expected_count(const WantedFrames& frames) {
  if (frames.turntable > 0) return frames.count();
  return std::max(frames.count(), frames.range ? frames.range->last + 1 : 0);
}

void render(const Words& typed) {
  const Words given = with_output(typed, checked(typed));
  const RenderArguments asked = arguments_of(given);
  check_files(asked, expected_count(asked.frames));
  Stats stats;
  Stopwatch total, phase;
  const Input input = within_limits([&] { return read_input(asked.model, asked.limits); });
  if (!asked.output.scene.empty()) check_names(input);
  const Loaded loaded = within_limits([&] { return load(input, merge_cameras(given, input.settings)); });
  const Scene& scene = loaded.scene;
  stats.load_ms = phase.lap();

  const RenderArguments arguments = with_places(loaded.words, [&] { return checked(loaded.words); });
  say_what_is_odd(scene, arguments.model);
  say_what_was_read(scene, arguments, stats.load_ms);
  const std::vector<WantedView> wanted = wanted_views(arguments, given, input, loaded);
  const std::vector<View> all_views =
      complete_views(loaded.ball, loaded.up, wanted, arguments.frames.turntable, arguments.size());
  const FrameRange range = arguments.frames.selected(all_views.size());
  const std::vector<View> views(all_views.begin() + static_cast<std::ptrdiff_t>(range.first),
                                all_views.begin() + static_cast<std::ptrdiff_t>(range.last) + 1);
  const WantedLights lights = wanted_lights(arguments, input, loaded);
  const std::vector<FrameFiles> files =
      with_places(loaded.words, [&] { return check_files(arguments, all_views.size()); });
  check_inputs_stay(files, arguments.output.scene, input, scene);
  say_what_was_made_up(wanted, all_views, range, lights);

  Renderer::Options options = renderer_options(arguments);
  options.up = loaded.up;
  Renderer renderer(scene, views[0], lights.lights, options);
  FrameWriter writer(arguments.output.format, arguments.output.layers);
  render_frames(renderer, views, files, writer, arguments.options.threads, stats);
  if (!arguments.output.scene.empty())
    save_scene(scene_of(input, loaded, arguments, all_views, lights.lights), arguments.output.scene);
  const std::string output = shown_output(arguments.output.files.picture, files);
  if (arguments.studio) note("picture: " + (files.size() == 1 ? files[0].picture.string() : output));
  if (arguments.studio && !input.is_scene) say_studio_command(arguments, output, loaded.words);

  stats.total_ms = total.lap();
  stats.model = arguments.model.string();
  stats.width = arguments.size().width;
  stats.height = arguments.size().height;
  stats.light_count = lights.lights.size();
  print_stats(stats, arguments.stats, scene);
  say_done(stats.total_ms / 1000);
}

}  // namespace

Command render_command() {
  const auto arguments = std::make_shared<RenderArguments>();  // what the table's rows set; their words say as much
  const auto words = std::make_shared<Words>();
  Command command;
  command.name = "render";
  command.summary = "Draw a model with exact shadows";
  command.text =
      "What neither flags nor the file say is made up: a view that holds the whole model, eight lights around\n"
      "it. Both are printed on standard error as flags, to be copied and changed. Angles are in degrees.\n"
      "MODEL may be a scene file (docs/scene-file.md): models, cameras, lights, and these flags as settings.\n"
      "facemap MODEL alone is facemap render MODEL --studio, and names the picture after the model.\n"
      "A file appears whole or not at all; what stood there stays until the new one is complete.\n"
      "Several pictures in one run (--camera several times, or --turntable) cost less than several runs:\n"
      "what is made for the lights is made once. An interrupt leaves the pictures that are complete.\n";
  command.options = recorded(render_options(*arguments), *words);
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
      {"facemap model.obj", "a picture to show: model.png"},
      {"facemap render model.obj -o out.png --up z --ground on --sky 0.5,0.6,0.7,0.2,0.2,0.2",
       "a model whose z points up, on a floor under a sky"},
      {"facemap render model.obj -o out.png --save-scene scene.toml && facemap render scene.toml -o out.png",
       "a picture, a file that says how it was made, and the same picture again"},
  };
  command.run = [arguments, words] {
    render(*words);
    return kDone;
  };
  return command;
}

}  // namespace facemap::program
