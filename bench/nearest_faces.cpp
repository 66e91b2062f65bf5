// What the camera sees, the transposed way: whole pictures of the made-up view, by projection and number of threads.
//   nearest_faces [FILE.obj ...] [Google Benchmark's options]
#include "picture/nearest_faces.h"

#include <benchmark/benchmark.h>
#include <facemap/renderer.h>

#include <memory>
#include <string>
#include <vector>

namespace {

using facemap::Projection;
using facemap::ProjectionKind;
using facemap::SampleGrid;
using facemap::Scene;

SampleGrid grid_of(const Scene& scene, ProjectionKind kind, int size) {
  const facemap::View view = facemap::make_up_view(scene);
  return {facemap::SpaceVector::looking_at(view.position, view.look_at, view.up),
          Projection(kind, view.field_angle, size, size), 1};
}

void see(benchmark::State& state, const Scene& scene, ProjectionKind kind, int threads) {
  const SampleGrid grid = grid_of(scene, kind, static_cast<int>(state.range(0)));
  const facemap::Executor executor(threads);
  std::size_t loose = 0;
  facemap::Counters counters;
  for (auto _ : state) {
    counters = {};
    const facemap::NearestFaces nearest = find_nearest_faces(scene, grid, executor, &counters);
    loose = nearest.loose.size();
    benchmark::DoNotOptimize(nearest.faces.data());
  }
  state.counters["faces"] = static_cast<double>(scene.face_count());
  state.counters["loose"] = static_cast<double>(loose);
  state.counters["by_double"] = static_cast<double>(counters.by_double);
  state.counters["by_exact"] = static_cast<double>(counters.by_exact);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  std::vector<std::unique_ptr<Scene>> scenes;
  for (int i = 1; i < argc; ++i) {
    scenes.push_back(std::make_unique<Scene>(Scene::load(argv[i])));
    const Scene& scene = *scenes.back();
    for (const auto& [kind, name] : {std::pair{ProjectionKind::Plane, "plane"}, {ProjectionKind::Surface, "surface"}}) {
      for (const int threads : {1, 2}) {
        const std::string title = std::string(argv[i]) + "/" + name + "/threads:" + std::to_string(threads);
        benchmark::RegisterBenchmark(title.c_str(), see, std::cref(scene), kind, threads)
            ->Arg(1024)
            ->Unit(benchmark::kMillisecond)
            ->UseRealTime();
      }
    }
  }
  benchmark::RunSpecifiedBenchmarks();
}
