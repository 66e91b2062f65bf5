#include "render_arguments.h"

#include <optional>
#include <string>

#include "light_flags.h"
#include "output.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

constexpr long long kMostPixels = 1LL << 30;  ///< of 32768 x 32768; --max-pixels may allow fewer

template <typename Value, typename Parse>
std::function<void(const std::string&)> append_to(std::vector<Value>& values, Parse parse) {
  return [&values, parse](const std::string& text) { values.push_back(parse(text)); };
}

template <typename Field>
struct ChosenOf {
  using Type = Field;
};
template <typename Field>
struct ChosenOf<std::optional<Field>> {
  using Type = Field;
};
template <typename Field>
using Chosen = typename ChosenOf<Field>::Type;

/// A row whose value is one of `choices`, in the order of the field's enumerators.
template <typename Field>
Option one_of(const std::string& flags, const std::string& default_text, const std::string& help, Field& field,
              const std::vector<std::string>& choices) {
  const auto set = [&field, choices](const std::string& text) {
    field = static_cast<Chosen<Field>>(parse_choice(text, choices));
  };
  return {flags, "KIND", default_text, help, set, false, choices};
}

fs::path parse_path(const std::string& text) { return text; }

}  // namespace

std::vector<Option> view_options(RenderArguments& a) {
  return {
      {"--camera", "X,Y,Z", "made up", "where the camera stands; given several times: a picture from each place",
       append_to(a.frames.cameras, parse_vector), true},
      {"--look-at", "X,Y,Z", "made up",
       "the point in the middle of the picture; this and the next two: once for all cameras, or once for each, in "
       "their order",
       append_to(a.frames.look_ats, parse_vector), true},
      {"--up", "y|z|X,Y,Z", "the file's",
       "the direction that points up: in the picture, for made-up views and lights, the sky and the ground. A glTF "
       "file "
       "says y, STL files are taken as z, all others as y",
       append_to(a.frames.ups, parse_direction), true},
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

namespace {

std::vector<Option> light_options(RenderArguments& a) {
  return {
      {"--light", "X,Y,Z[,R,G,B]", "eight made up",
       "a point light and its linear colour, 1,1,1 if left out; once a light; range=R or falloff may follow: nothing "
       "beyond R, fading with the squared distance",
       append_to(a.lights, parse_light), true},
      {"--spot", "X,Y,Z,DX,DY,DZ,ANGLE[,INNER][,R,G,B]", "",
       "a spot light, its direction and the angle of its cone in degrees, from side to side; full intensity within "
       "INNER, 0 if left out; then as --light",
       append_to(a.lights, parse_spot), true},
      {"--sun", "DX,DY,DZ[,R,G,B]", "",
       "a directional light, by the way its light goes; in a light mask point lights come first, then spots, then "
       "these",
       append_to(a.lights, parse_sun), true},
      {"--intensity", "FACTOR", "1", "multiplies the colour of every light", into(a.intensity, parse_at_least_0)},
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
      one_of(
          "--filter", "box",
          "how samples make a pixel: box, the mean of those in it; blackman-harris, weighted by a smooth window that "
          "reaches into the neighbours",
          a.options.filter, {"box", "blackman-harris"}),
      {"--filter-width", "PIXELS", "1.5", "width of that window, at most 16",
       into(a.options.filter_width, parse_filter_width)},
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

/// From light to the levels of a picture.
std::vector<Option> display_options(DisplayTransform& display) {
  return {
      {"--exposure", "STOPS", "0", "PNG and JPEG: brighter by so many stops, each twice the light; -1 is half",
       into(display.exposure, parse_exposure)},
      one_of("--curve", "none", "PNG and JPEG: none, or filmic: highlights fade instead of being cut off",
             display.curve, {"none", "filmic"}),
      one_of("--transfer", "srgb", "PNG and JPEG: srgb, or linear: levels in proportion to light (PNG alone)",
             display.transfer, {"srgb", "linear"}),
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

/// Throws for a lens that pictures of this size cannot have, and for a part that they have not.
void check_picture(const RenderArguments& arguments) {
  arguments.frames.each();
  View view;
  set_lens(arguments.frames.lens, arguments.size(), view);
  arguments.part.pixels(arguments.size());
}

}  // namespace

std::vector<Option> render_options(RenderArguments& a) {
  std::vector<Option> options = {
      {"MODEL", "", "", "an OBJ, glTF, PLY or STL file, or a scene file (TOML); - reads it from standard input",
       into(a.model, parse_path)},
      {"-o,--output", "FILE", "",
       "the picture: .png, .jpg, .exr, .pfm or .npy; - writes it to standard output; {model} in the name stands for "
       "the model's name, {n} for the picture's number from 0, {n:04} for the same with four digits",
       into(a.output.files.picture, parse_path)},
      {"--size", "WxH", "1024x1024", "width and height in pixels",
       into(a.wanted_size, [](const std::string& text) { return parse_size_within(text, kMostPixels); })},
  };
  append(options, part_options(a.part));
  append(options, view_options(a));
  append(options, lens_options(a.frames.lens));
  append(options, light_options(a));
  append(options, scene_options(a));
  append(options, quality_options(a));
  append(options, display_options(a.output.format.display));
  append(options, output_options(a.output, a.frames.range));
  append(options, work_options(a));
  append(options, limit_options(a));
  append(options, {
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
                      {"-v,--verbose", "", "", "says what was read, what was made up, and how long each phase took",
                       [&a](const std::string&) { a.verbose = true; }},
                      {"--log-json", "", "",
                       "messages as JSON objects, one a line on standard error: \"event\" is warning, note, progress, "
                       "done or error",
                       [&a](const std::string&) { a.log_json = true; }},
                  });
  return options;
}

RenderArguments arguments_of(const Words& words) {
  RenderArguments arguments;
  set_options(render_options(arguments), words);
  arguments.limits.threads = arguments.options.threads;
  return arguments;
}

void check_limits(const RenderArguments& arguments) {
  const Size size = arguments.size();
  if (static_cast<long long>(size.width) * size.height > arguments.max_pixels) {
    throw UsageError("--size: '" + std::to_string(size.width) + "x" + std::to_string(size.height) +
                     "' is not a size this program takes: " + std::to_string(arguments.max_pixels) +
                     " pixels at most (--max-pixels)");
  }
  if (arguments.quiet && arguments.verbose) throw UsageError("--quiet and --verbose are given");
}

std::vector<FrameFiles> check_files(const RenderArguments& arguments, std::size_t all) {
  check_picture(arguments);
  if (arguments.model.empty()) throw UsageError("no model is given");
  if (is_standard_output(arguments.output.files.picture) && arguments.stats != StatsFormat::None) {
    throw UsageError("-o - and --stats would both write to standard output");
  }
  if (is_standard_output(arguments.output.scene) && arguments.stats != StatsFormat::None)
    throw UsageError("--save-scene - and --stats would both write to standard output");
  return check_output_files(arguments.output, arguments.model, arguments.frames.selected(all), all);
}

Renderer::Options renderer_options(const RenderArguments& arguments) {
  Renderer::Options options = arguments.options;
  options.width = arguments.size().width;
  options.height = arguments.size().height;
  options.crop = arguments.part.pixels(arguments.size());
  options.sampling = arguments.samples.sampling;
  options.samples = arguments.samples.side;
  options.planes = arguments.output.planes();
  return options;
}

}  // namespace facemap::program
