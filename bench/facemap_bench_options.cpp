#include "facemap_bench_options.h"

#include <CLI/CLI.hpp>
#include <cstdlib>

namespace facemap::bench {

Options read_options(int argc, char** argv) {
  Options options;
  CLI::App parser("FaceMap beside Embree on the same rays, points, lights and rules, in one process.");
  parser.add_option(
      "--scene", options.scenes,
      "chessboard, grass, bust, typewriter (NAME@DETAIL: finer), models/NAME, rooms/NAME, or an OBJ file; "
      "may be given again");
  parser.add_option("--size", options.size, "pixels a side")->capture_default_str()->check(CLI::Range(1, 32768));
  parser.add_option("--samples", options.samples, "a side of the grid of rays in a pixel")
      ->capture_default_str()
      ->check(CLI::Range(1, 16));
  parser.add_option("--lights", options.lights, "the first N of the scene's own; more: N on two rings about it")
      ->check(CLI::PositiveNumber);
  parser.add_option("--threads", options.threads)->capture_default_str()->check(CLI::PositiveNumber);
  parser.add_option("--repeat", options.repeat, "interleaved rounds")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  parser.add_option("--json", options.json, "file for one JSON object a scene");
  parser.add_flag("--confirm", options.confirm, "ask FaceMap's lists about every answer that differs (slow)");
  parser.add_option("--projection", options.projection, "plane or surface")
      ->transform(CLI::CheckedTransformer(std::map<std::string, ProjectionKind>{{"plane", ProjectionKind::Plane},
                                                                                {"surface", ProjectionKind::Surface}}));
  parser.add_option("--strategy", options.strategy, "auto, lists or transposed")
      ->transform(CLI::CheckedTransformer(
          std::map<std::string, Renderer::Strategy>{{"auto", Renderer::Strategy::Auto},
                                                    {"lists", Renderer::Strategy::Lists},
                                                    {"transposed", Renderer::Strategy::Transposed}}));
  parser.add_flag("--cpu-time", options.cpu_time,
                  "processor time instead of the wall clock's (one thread, busy machine)");
  try {
    parser.parse(argc, argv);
  } catch (const CLI::ParseError& stop) {
    std::exit(parser.exit(stop));
  }
  return options;
}

}  // namespace facemap::bench
