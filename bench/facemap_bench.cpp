// FaceMap beside Embree, in one process, on the same rays, points, lights and rules.
//
//   facemap-bench                          the four generated scenes and the models that are there, 7 rounds
//   facemap-bench --scene grass            one scene; may be given again; chessboard@4 is finer (--help)
//   facemap-bench --size 2048 --threads 2 --repeat 15 --json out.json
//   FACEMAP_TARGET=avx2 facemap-bench      both held to AVX2
//
// Timed is the way from vertices, indices, camera and lights in memory to face ids and light masks in memory, tables
// and normals included. Cold: from nothing; warm: the camera moved by 5 degrees, lights and what is kept of them stay.
// Speed is Embree's median time over ours; Embree is used in the way that is fastest for the scene.

#include <facemap/error.h>

#include <cstdio>
#include <exception>
#include <fstream>

#include "facemap_bench_cases.h"
#include "facemap_bench_options.h"
#include "facemap_bench_report.h"
#include "facemap_bench_rounds.h"

using namespace facemap::bench;

namespace {

void run(const Options& options) {
  std::ofstream json;
  if (!options.json.empty()) {
    json.open(options.json);
    if (!json) throw facemap::Error("cannot write " + options.json);
  }
  std::printf("%s\n", setting(options).c_str());
  std::vector<Speeds> speeds;
  for (const std::string& name : options.scenes.empty() ? default_case_names() : options.scenes) {
    const Case question = make_case(name, options);
    const Measured measured = measure(question, options);
    print_case(question, measured, options);
    json << json_line(question, measured, options) << std::flush;
    speeds.push_back({name, measured.cold.speed(), measured.warm.speed()});
  }
  print_summary(speeds);
}

}  // namespace

int main(int argc, char** argv) {
  try {
    run(read_options(argc, argv));
  } catch (const std::exception& error) {
    std::fprintf(stderr, "facemap-bench: %s\n", error.what());
    return 1;
  }
}
