// What a scene costs before the first question: made from a mesh, and its closed parts found and asked.
//
//     scene [--benchmark_...] FILE.obj ...
//
// The mesh is in memory and moved into the scene; its copy for each run is not measured, the scene's end is. Times are
// of the clock; `make/2` uses two threads. `outside` asks from the centre of the bounds, where parts need a ray.

#include <benchmark/benchmark.h>
#include <facemap/scene.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "parallel/executor.h"
#include "scene/closed_parts.h"

namespace {

using namespace facemap;

void make_scene(benchmark::State& state, const Scene& model) {
  for (auto _ : state) {
    state.PauseTiming();
    Mesh mesh = model.mesh();
    std::vector<Material> materials = model.materials();
    state.ResumeTiming();
    const Scene scene(std::move(mesh), std::move(materials), static_cast<int>(state.range(0)));
    benchmark::DoNotOptimize(scene.bounding_radius());
  }
  state.counters["faces"] = static_cast<double>(model.face_count());
}

void find_closed_parts(benchmark::State& state, const Scene& scene) {
  const Executor executor(static_cast<int>(state.range(0)));
  std::size_t count = 0;
  for (auto _ : state) count = ClosedParts(scene, executor).closed_count();
  state.counters["closed"] = static_cast<double>(count);
}

void skip_entries(benchmark::State& state, const Scene& scene) {
  const ClosedParts parts(scene, Executor(1));
  const Vector far(scene.centre() + 2.0 * scene.bounding_radius() * DVector(1, 0.5, 0.25));
  for (auto _ : state) benchmark::DoNotOptimize(parts.skippable_entries(scene, far, far).data());
}

void ask_outside(benchmark::State& state, const Scene& scene) {
  const ClosedParts parts(scene, Executor(1));
  for (auto _ : state) benchmark::DoNotOptimize(parts.outside(scene, Vector(scene.centre())).data());
}

int run(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  std::vector<std::unique_ptr<const Scene>> scenes;
  for (int i = 1; i < argc; ++i) {
    scenes.push_back(std::make_unique<const Scene>(Scene::load(argv[i])));
    const Scene& scene = *scenes.back();
    const auto add = [&](const char* what, void (*measure)(benchmark::State&, const Scene&)) {
      const std::string name = std::filesystem::path(argv[i]).filename().string() + "/" + what;
      return benchmark::RegisterBenchmark(name.c_str(), [&scene, measure](benchmark::State& s) { measure(s, scene); })
          ->Unit(benchmark::kMillisecond)
          ->UseRealTime();
    };
    add("make", make_scene)->Arg(1)->Arg(2);
    add("closed_parts", find_closed_parts)->Arg(1)->Arg(2);
    add("skippable_entries", skip_entries);
    add("outside", ask_outside);
  }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& failure) {
    std::fprintf(stderr, "%s\n", failure.what());
    return 1;
  }
}
