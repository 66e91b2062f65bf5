// Finding the points that a picture sees, and shading them: 1024 x 1024 samples, eight lights, one thread.

#include "picture/seen_points.h"

#include <benchmark/benchmark.h>
#include <facemap/camera.h>
#include <facemap/generators.h>
#include <facemap/renderer.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "math/elementary.h"

namespace {

using namespace facemap;

constexpr int kSize = 1024;  // pixels a side

struct Picture {
  Picture(const std::string& name, ProjectionKind kind) : Picture(generate_scene(name), kind) {}

  Picture(GeneratedScene made, ProjectionKind kind)
      : scene(std::move(made.mesh)),
        grid{SpaceVector::looking_at(made.camera_position, made.look_at, made.up),
             Projection(kind, made.field_angle_deg * elementary::kPi / 180, kSize, kSize), 1} {
    for (const auto& light : made.lights) {
      lights.push_back({light.position, {light.color.x, light.color.y, light.color.z}, light.intensity});
      positions.push_back(light.position);
    }
    Camera::Options options;
    options.projection = kind;
    options.field_angle = grid.projection.field_angle();
    const Camera camera(scene, grid.frame, options);
    for (int row = 0; row < kSize; ++row) {
      for (int column = 0; column < kSize; ++column) {
        nearest.faces.push_back(camera.nearest(grid.direction(column, row)).face);
      }
    }
  }

  Scene scene;
  SampleGrid grid;
  NearestFaces nearest;
  std::vector<Light> lights;
  std::vector<Vector> positions;
};

const Picture& picture_of(const std::string& name, ProjectionKind kind) {
  static std::map<std::pair<std::string, ProjectionKind>, std::unique_ptr<Picture>> pictures;
  auto& picture = pictures[{name, kind}];
  if (picture == nullptr) picture = std::make_unique<Picture>(name, kind);
  return *picture;
}

void find_points(benchmark::State& state, const std::string& name, ProjectionKind kind) {
  const Picture& picture = picture_of(name, kind);
  const Executor executor(1);
  std::size_t count = 0;
  for (auto _ : state) {
    const SeenPoints seen = find_seen_points(picture.scene, picture.grid, picture.nearest, picture.positions, executor);
    count = seen.points.size();
    benchmark::DoNotOptimize(seen.points.x.data());
  }
  state.counters["points"] = static_cast<double>(count);
}

}  // namespace

BENCHMARK_CAPTURE(find_points, chessboard, "chessboard", ProjectionKind::Plane)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(find_points, grass, "grass", ProjectionKind::Plane)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(find_points, bust, "bust", ProjectionKind::Plane)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(find_points, bust_surface, "bust", ProjectionKind::Surface)->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
