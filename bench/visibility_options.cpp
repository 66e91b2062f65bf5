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
  return settings;
}

}  // namespace facemap::bench
