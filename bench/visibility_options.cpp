#include "visibility_options.h"

#include <CLI/CLI.hpp>
#include <cstdlib>

namespace facemap::bench {

VisibilitySettings read_visibility_settings(int argc, char** argv) {
  VisibilitySettings settings;
  CLI::App parser("Which points are visible from a point: FaceMap beside Embree, in one process.");
  parser.add_option("--scene", settings.scenes, "a name or file as facemap-bench has them; may be given again")
      ->capture_default_str();
  parser.add_option("--points", settings.points, "random points on the faces")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  parser.add_flag("--many", settings.many, "many origins at once: the scene is grass, and 10,000 points, unless given");
  parser.add_option("--origins", settings.origins, "with --many")->capture_default_str()->check(CLI::PositiveNumber);
  parser.add_option("--threads", settings.threads, "numbers of threads, one row each")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  parser.add_option("--repeat", settings.repeat, "interleaved rounds")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  parser.add_option("--seed", settings.seed)->capture_default_str();
  try {
    parser.parse(argc, argv);
  } catch (const CLI::ParseError& stop) {
    std::exit(parser.exit(stop));
  }
  if (settings.many && parser.count("--scene") == 0) settings.scenes = {"grass"};
  if (settings.many && parser.count("--points") == 0) settings.points = 10000;
  return settings;
}

}  // namespace facemap::bench
