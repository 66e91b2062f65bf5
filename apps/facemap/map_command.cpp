#include <facemap/facemap.h>

#include <algorithm>
#include <iostream>
#include <memory>
#include <optional>
#include <thread>

#include "commands.h"
#include "exit_codes.h"
#include "file_format.h"
#include "hit_picture.h"
#include "input_files.h"
#include "model.h"
#include "output.h"
#include "pending_files.h"
#include "text_values.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

struct MapArguments {
  fs::path model, output;
  Size size;
  std::optional<Vector> at, look_at;
  double field_angle = parse_degrees("360");
  Builder builder = Builder::Cover;
  int threads = 0;  ///< 0: as many as there are processors
  bool quiet = false;
};

SpaceVector frame_of(const MapArguments& arguments, const Scene& scene) {
  const DVector target = arguments.look_at ? DVector(*arguments.look_at) : scene.centre();
  const DVector sight = target - DVector(*arguments.at);
  return SpaceVector::looking_along(*arguments.at, sight == DVector(0) ? DVector(0, 0, -1) : sight);
}

int thread_count(int wanted) {
  return wanted > 0 ? wanted : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void draw_map(const MapArguments& arguments) {
  if (arguments.model.empty()) throw UsageError("no model is given");
  if (!arguments.at) throw UsageError("no place is given: add --at X,Y,Z");
  const FileFormat format = format_of(arguments.output);
  check_picture_output(arguments.output, arguments.model);
  const Scene scene = load_model(arguments.model, arguments.quiet, arguments.threads);
  check_images_stay(arguments.output, scene.images());

  Camera::Options options;
  options.field_angle = arguments.field_angle;
  options.width = arguments.size.width;
  options.height = arguments.size.height;
  options.builder = arguments.builder;
  options.keep_all = true;
  const Camera map(scene, frame_of(arguments, scene), options);
  const std::vector<int> hits = count_hits_by_texel(map, thread_count(arguments.threads));
  const Image image = hit_picture(hits, options.width, options.height);
  write_output(arguments.output, encode_picture(image, format, {}, {}, arguments.threads));
  if (!arguments.quiet) {
    std::cerr << "facemap: map: " << map.entry_count() << " entries, " << map.memory_bytes() << " bytes, at most "
              << *std::max_element(hits.begin(), hits.end()) << " faces behind one another\n";
  }
}

}  // namespace

Command map_command() {
  const auto arguments = std::make_shared<MapArguments>();
  MapArguments& a = *arguments;
  const auto path = [](const std::string& text) { return fs::path(text); };
  Command command;
  command.name = "map";
  command.summary = "Draw how many faces lie in each direction from a point";
  command.text =
      "The picture is a FaceMap seen from inside: the middle is the direction to --look-at, the distance from the\n"
      "middle is the angle. The ray through each texel's centre meets so many faces: white is none, darker is\n"
      "more; the legend below has the numbers. Pale blue is outside of 360 degrees.\n";
  command.options = {
      {"MODEL", "", "", "the model: an OBJ, glTF, PLY or STL file; - reads it from standard input",
       into(a.model, path)},
      {"--at", "X,Y,Z", "", "the point: a light's or a camera's place", into(a.at, parse_vector)},
      {"-o,--output", "FILE", "", "the picture: .png, .jpg, .exr, .pfm or .npy; - writes PNG to standard output",
       into(a.output, path)},
      {"--size", "WxH", "1024x1024", "texels; the legend comes on top", into(a.size, parse_size)},
      {"--field-angle", "DEG", "360", "degrees across the shorter side", into(a.field_angle, parse_degrees)},
      {"--look-at", "X,Y,Z", "the model's centre", "the point in the middle", into(a.look_at, parse_vector)},
      {"--builder",
       "KIND",
       "cover",
       "cover (exact) or fill (as published)",
       [&a](const std::string& text) {
         a.builder = parse_choice(text, {"cover", "fill"}) ? Builder::Fill : Builder::Cover;
       },
       false,
       {"cover", "fill"}},
      {"--threads", "N", "0", "threads at work; 0: as many as there are processors", into(a.threads, parse_threads)},
      {"-q,--quiet", "", "", "no warnings, no counts", [&a](const std::string&) { a.quiet = true; }},
  };
  command.examples = {
      {"facemap map model.obj --at 2,3,1 -o map.png", "all directions from a point"},
      {"facemap map model.obj --at 2,3,1 --look-at 0,0,0 --field-angle 90 --size 512x512 -o map.png",
       "what a lamp there shines on"},
  };
  command.run = [arguments] {
    draw_map(*arguments);
    return kDone;
  };
  return command;
}

}  // namespace facemap::program
