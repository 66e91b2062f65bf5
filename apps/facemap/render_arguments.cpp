#include "render_arguments.h"

#include <algorithm>
#include <optional>
#include <set>
#include <string>

#include "light_flags.h"
#include "output.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxFrames = 100'000;
constexpr int kBits[] = {8, 16, 32};  ///< of a channel

std::vector<std::string> plane_names() {
  std::vector<std::string> names;
  for (const Plane plane : all_planes()) names.emplace_back(name_of(plane));
  return names;
}

bool has_file(const FrameFiles& files, Plane plane) {
  return std::any_of(files.planes.begin(), files.planes.end(), [&](const PlaneFile& f) { return f.plane == plane; });
}

/// NAME=FILE, or NAME alone: a layer of the picture.
void add_plane(RenderArguments& arguments, const std::string& text) {
  const std::size_t equals = std::min(text.find('='), text.size());
  const std::string name = text.substr(0, equals);
  const Plane plane = all_planes()[static_cast<std::size_t>(parse_choice(name, plane_names()))];
  if (equals + 1 == text.size()) throw UsageError("'" + text + "' names no file");
  if (equals == text.size() ? arguments.layers.has(plane) : has_file(arguments.files, plane)) {
    throw UsageError(name + " is given more than once");
  }
  if (equals == text.size()) return arguments.layers.add(plane);
  arguments.files.planes.push_back({plane, text.substr(equals + 1)});
}

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

std::vector<Option> output_options(RenderArguments& a) {
  return {
      {"--format", "FORMAT", "by name",
       "the picture's format, whatever its file is called; of -o - it is png if not said",
       [&a](const std::string& text) { a.format.format = static_cast<FileFormat>(parse_choice(text, format_names())); },
       false, format_names()},
      {"--bits",
       "N",
       "",
       "bits of a colour: PNG 8 (if not said) or 16, EXR 16 (half, if not said) or 32 (float)",
       into(a.format.bits,
            [](const std::string& text) {
              return kBits[parse_choice(text, {"8", "16", "32"})];
            }),
       false,
       {"8", "16", "32"}},
      {"--quality", "N", "90", "of JPEG, 1 to 100",
       into(a.format.quality, [](const std::string& text) { return parse_whole_number(text, 1, 100); })},
      {"--exposure", "STOPS", "0", "PNG and JPEG: brighter by so many stops, each twice the light; -1 is half",
       into(a.format.display.exposure, parse_exposure)},
      one_of("--curve", "none", "PNG and JPEG: none, or filmic: highlights fade instead of being cut off",
             a.format.display.curve, {"none", "filmic"}),
      one_of("--transfer", "srgb", "PNG and JPEG: srgb, or linear: levels in proportion to light (PNG alone)",
             a.format.display.transfer, {"srgb", "linear"}),
      {"--aov", "NAME[=FILE]", "",
       "writes a plane: depth (along the ray), z (along the sight), position, normal, face-normal, albedo, uv, id, "
       "object, material, lights (one bit a light, 1 is lit) or shadows (how many lights are hidden); to a .npy, .exr, "
       ".pfm, or, for the eye, .png or .jpg; without a file it is a layer of an EXR picture; once a plane; {n} and "
       "{model} as in -o",
       [&a](const std::string& text) { add_plane(a, text); }, true},
      {"--frames", "A..B", "all", "of several pictures only these: numbers from 0, both ends count; 7 or 0-9 will do",
       into(a.frames.range, parse_frame_range)},
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
      {"MODEL", "", "", "the model: an OBJ, glTF, PLY or STL file", into(a.model, parse_path)},
      {"-o,--output", "FILE", "",
       "the picture: .png, .jpg, .exr, .pfm or .npy; - writes it to standard output; {model} in the name stands for "
       "the "
       "model's name, {n} for the picture's number from 0, {n:04} for the same with four digits",
       into(a.files.picture, parse_path)},
      {"--size", "WxH", "1024x1024", "width and height in pixels", into(a.wanted_size, parse_size)},
  };
  append(options, part_options(a.part));
  append(options, view_options(a));
  append(options, lens_options(a.frames.lens));
  append(options, light_options(a));
  append(options, quality_options(a));
  append(options, output_options(a));
  append(options, work_options(a));
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
                  });
  return options;
}

namespace {

/// What the flags say of the files must make sense.
void check_formats(const RenderArguments& arguments) {
  const fs::path& picture = arguments.files.picture;
  const FileFormat format = picture_format(picture, arguments.format);
  for (const PlaneFile& plane : arguments.files.planes) {
    if (is_standard_output(plane.file)) throw UsageError("--aov: standard output takes the picture alone");
    plane_format(plane.file, plane.plane);
  }
  for (const Plane plane : all_planes()) {
    if (!arguments.layers.has(plane) || format == FileFormat::Exr) continue;
    const std::string name = name_of(plane);
    throw UsageError("--aov " + name + ": only an EXR picture has layers; give it a file: " + name + "=FILE");
  }
  if (is_standard_output(picture) && arguments.stats != StatsFormat::None) {
    throw UsageError("-o - and --stats would both write to standard output");
  }
}

/// Files by the names that the file system has for them.
class KnownFiles {
 public:
  void add(const fs::path& file) {
    if (is_standard_output(file)) return;
    std::error_code failed;
    const fs::path name = fs::weakly_canonical(fs::absolute(file), failed);
    if (!names_.insert(failed ? file.lexically_normal() : name).second) {
      throw UsageError(file.string() + ": two outputs name this file");
    }
  }

 private:
  std::set<fs::path> names_;
};

}  // namespace

std::vector<FrameFiles> check_files(const RenderArguments& arguments) {
  check_picture(arguments);
  if (arguments.model.empty()) throw UsageError("no model is given");
  if (arguments.files.picture.empty()) check_picture_output(arguments.files.picture, arguments.model);
  const FrameRange range = arguments.frames.selected();
  const auto names = [&](const fs::path& pattern) {
    return frame_files(pattern, arguments.model, arguments.frames.count(), range);
  };
  std::vector<FrameFiles> frames;
  KnownFiles known;
  for (const fs::path& picture : names(arguments.files.picture)) {
    frames.push_back({picture, {}});
    check_picture_output(picture, arguments.model);
    known.add(picture);
  }
  for (const auto& [plane, pattern] : arguments.files.planes) {
    const std::vector<fs::path> files = names(pattern);
    for (std::size_t i = 0; i < files.size(); ++i) {
      check_output(files[i], arguments.model);
      known.add(files[i]);
      frames[i].planes.push_back({plane, files[i]});
    }
  }
  check_formats(arguments);
  return frames;
}

Renderer::Options renderer_options(const RenderArguments& arguments) {
  Renderer::Options options = arguments.options;
  options.width = arguments.size().width;
  options.height = arguments.size().height;
  options.crop = arguments.part.pixels(arguments.size());
  options.sampling = arguments.samples.sampling;
  options.samples = arguments.samples.side;
  options.planes = arguments.layers;
  for (const PlaneFile& plane : arguments.files.planes) options.planes.add(plane.plane);
  return options;
}

}  // namespace facemap::program
