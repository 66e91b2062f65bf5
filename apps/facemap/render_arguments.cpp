#include "render_arguments.h"

#include <set>
#include <string>

#include "output.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxFrames = 100'000;

void add_plane(FrameFiles& files, const std::string& text) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals + 1 == text.size()) throw UsageError("'" + text + "' is not NAME=FILE");
  fs::path* const planes[] = {&files.ids, &files.depths, &files.lights};
  fs::path& file = *planes[parse_choice(text.substr(0, equals), {"id", "depth", "lights"})];
  if (!file.empty()) throw UsageError(text.substr(0, equals) + " is given more than once");
  file = text.substr(equals + 1);
}

template <typename Value, typename Parse>
std::function<void(const std::string&)> append_to(std::vector<Value>& values, Parse parse) {
  return [&values, parse](const std::string& text) { values.push_back(parse(text)); };
}

/// A row whose value is one of `choices`, in the order of the field's enumerators.
template <typename Field>
Option one_of(const std::string& flags, const std::string& default_text, const std::string& help, Field& field,
              const std::vector<std::string>& choices) {
  const auto set = [&field, choices](const std::string& text) {
    field = static_cast<Field>(parse_choice(text, choices));
  };
  return {flags, "KIND", default_text, help, set, false, choices};
}

fs::path parse_path(const std::string& text) { return text; }

std::vector<Option> view_options(RenderArguments& a) {
  return {
      {"--camera", "X,Y,Z", "made up", "where the camera stands; given several times: a picture from each place",
       append_to(a.frames.cameras, parse_vector), true},
      {"--look-at", "X,Y,Z", "made up",
       "the point in the middle of the picture; this and the next two: once for all cameras, or once for each, in "
       "their order",
       append_to(a.frames.look_ats, parse_vector), true},
      {"--up", "X,Y,Z", "0,1,0", "the direction that points up in the picture", append_to(a.frames.ups, parse_vector),
       true},
      {"--field-angle", "DEG", "50",
       "the field of view in degrees: across the shorter side (surface, up to 360) or from bottom to top (plane, "
       "below 180)",
       append_to(a.frames.field_angles, parse_degrees), true},
      one_of(
          "--projection", "surface",
          "surface: the paper's, distance from the middle is proportional to the angle; plane: perspective, straight "
          "lines stay straight",
          a.frames.projection, {"surface", "plane"}),
      {"--turntable", "N", "",
       "N pictures: the camera goes once around the point in the middle, about the direction that points up",
       into(a.frames.turntable, [](const std::string& text) { return parse_whole_number(text, 1, kMaxFrames); })},
  };
}

std::vector<Option> light_options(RenderArguments& a) {
  return {
      {"--light", "X,Y,Z[,R,G,B]", "eight made up",
       "a point light and its linear colour, 1,1,1 if left out; once a light", append_to(a.lights, parse_light), true},
      {"--intensity", "FACTOR", "1", "multiplies the colour of every light", into(a.intensity, parse_number)},
      one_of("--falloff", "constant", "how light fades with distance: constant or inverse-square", a.options.falloff,
             {"constant", "inverse-square"}),
      {"--background", "COLOR", "0,0,0", "where no face is: linear r,g,b or sRGB #rrggbb",
       into(a.options.background, parse_color)},
  };
}

std::vector<Option> quality_options(RenderArguments& a) {
  const auto on_off = [](const std::string& text) { return parse_choice(text, {"off", "on"}) == 1; };
  return {
      {"--samples", "N", "1",
       "rays a pixel: 1; a grid such as 4x4; edges for one ray and 4x4 where a pixel may hold an edge (edges:8 for "
       "8x8)",
       into(a.samples, parse_samples)},
      one_of("--normals", "smooth", "smooth (where the file has normals or smoothing groups) or flat",
             a.options.normals, {"flat", "smooth"}),
      {"--terminator-fix",
       "on|off",
       "on",
       "keeps coarse smooth surfaces from shadowing themselves in facets",
       into(a.options.shadow_terminator_fix, on_off),
       false,
       {"off", "on"}},
      one_of("--builder", "cover",
             "how maps are filled: cover is exact; fill is as published and can miss a face at its edge",
             a.options.builder, {"cover", "fill"}),
  };
}

/// These change time and memory alone.
std::vector<Option> work_options(RenderArguments& a) {
  return {
      {"--threads", "N", "0", "threads at work; 0: as many as there are processors",
       into(a.options.threads, parse_threads)},
      one_of("--strategy", "auto",
             "lists: the paper's, a map of faces for each light; transposed: the faces run over a map of the points in "
             "sight; "
             "auto: what promises to be faster",
             a.options.strategy, {"auto", "lists", "transposed"}),
      {"--map-memory", "SIZE", "no limit", "what maps and working memory may take, as far as possible: 512M, 2G",
       into(a.options.map_memory, parse_memory)},
  };
}

void append(std::vector<Option>& options, std::vector<Option> more) {
  options.insert(options.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

std::vector<Option> render_options(RenderArguments& a) {
  std::vector<Option> options = {
      {"MODEL", "", "", "the model: an OBJ, glTF, PLY or STL file", into(a.model, parse_path)},
      {"-o,--output", "FILE", "",
       "the picture: PNG, 8-bit sRGB; - writes it to standard output; {n} in the name stands for the picture's number, "
       "from 0",
       into(a.files.picture, parse_path)},
      {"--size", "WxH", "1024x1024", "width and height in pixels", into(a.size, parse_size)},
  };
  append(options, view_options(a));
  append(options, light_options(a));
  append(options, quality_options(a));
  append(options, work_options(a));
  append(options, {
                      {"--aov", "NAME=FILE", "",
                       "writes a plane as a NumPy .npy file: id (int32, -1 for none), depth (float32, along the ray, "
                       "inf for none), "
                       "lights (uint8, one bit a light, 1 is lit); once a plane; {n} as in -o",
                       [&a](const std::string& text) { add_plane(a.files, text); }, true},
                      {"--stats",
                       "FORMAT",
                       "",
                       "prints times, memory, counts and the way taken on standard output: json or text",
                       [&a](const std::string& text) {
                         a.stats = parse_choice(text, {"json", "text"}) == 0 ? StatsFormat::Json : StatsFormat::Text;
                       },
                       false,
                       {"json", "text"}},
                      {"-q,--quiet", "", "", "no warnings, no made-up flags, no progress",
                       [&a](const std::string&) { a.quiet = true; }},
                  });
  return options;
}

std::vector<FrameFiles> check_files(const RenderArguments& arguments) {
  if (arguments.model.empty()) throw UsageError("no model is given");
  if (arguments.files.picture.empty()) check_png_output(arguments.files.picture, arguments.model);
  if (is_standard_output(arguments.files.picture) && arguments.stats != StatsFormat::None) {
    throw UsageError("-o - and --stats would both write to standard output");
  }
  std::vector<FrameFiles> frames(arguments.frames.count());
  std::set<fs::path> known;
  for (fs::path FrameFiles::*const member :
       {&FrameFiles::picture, &FrameFiles::ids, &FrameFiles::depths, &FrameFiles::lights}) {
    if ((arguments.files.*member).empty()) continue;
    const std::vector<fs::path> files = frame_files(arguments.files.*member, frames.size());
    for (std::size_t i = 0; i < frames.size(); ++i) {
      frames[i].*member = files[i];
      (member == &FrameFiles::picture ? check_png_output : check_output)(files[i], arguments.model);
      if (!known.insert(files[i].lexically_normal()).second) {
        throw UsageError(files[i].string() + ": two outputs name this file");
      }
    }
  }
  return frames;
}

Renderer::Options renderer_options(const RenderArguments& arguments) {
  Renderer::Options options = arguments.options;
  options.width = arguments.size.width;
  options.height = arguments.size.height;
  options.sampling = arguments.samples.sampling;
  options.samples = arguments.samples.side;
  options.want_ids = !arguments.files.ids.empty();
  options.want_depths = !arguments.files.depths.empty();
  options.want_lights = !arguments.files.lights.empty();
  return options;
}

}  // namespace facemap::program
