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

#include "math/dvector.h"
#include "render/shade_picture.h"

namespace {

using namespace facemap;

constexpr int kSize = 1024;  // pixels a side

// Area-weighted, over all faces of a vertex.
void add_smooth_normals(Mesh& mesh) {
  std::vector<DVector> sums(mesh.positions.size(), DVector(0));
  for (const Corners& t : mesh.triangles) {
    const DVector a(mesh.positions[t[0]]), b(mesh.positions[t[1]]), c(mesh.positions[t[2]]);
    for (const std::uint32_t corner : t) sums[corner] += cross(b - a, c - a);
  }
  for (const DVector& sum : sums) mesh.normals.push_back(Vector(sum));
  mesh.normal_corners = mesh.triangles;
}

GeneratedScene generate_smooth(const std::string& name) {
  GeneratedScene made = generate_scene(name);
  add_smooth_normals(made.mesh);
  return made;
}

struct Picture {
  Picture(const std::string& name, ProjectionKind kind) : Picture(generate_smooth(name), kind) {}

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
    options.field_angle = grid.lens.projection()->field_angle();
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

// As if every light that a point faces were seen from it.
void shade(benchmark::State& state, const std::string& name, Renderer::Normals normals) {
  const Picture& picture = picture_of(name, ProjectionKind::Plane);
  const Executor executor(1);
  Renderer::Options options;
  options.normals = normals;
  const SeenPoints seen = find_seen_points(picture.scene, picture.grid, picture.nearest, picture.positions, executor);
  std::vector<Color> colors(picture.grid.count());
  for (auto _ : state) {
    shade_points(picture.scene, picture.grid, seen, picture.lights, options, executor, colors);
    benchmark::DoNotOptimize(colors.data());
  }
  state.counters["points"] = static_cast<double>(seen.points.size());
}

void find_moved(benchmark::State& state, const std::string& name) {
  const Picture& picture = picture_of(name, ProjectionKind::Plane);
  const Executor executor(1);
  SeenPoints seen = find_seen_points(picture.scene, picture.grid, picture.nearest, picture.positions, executor);
  std::size_t count = 0;
  for (auto _ : state) {
    const MovedPoints moved =
        find_moved_points(picture.scene, picture.grid, seen, picture.lights, Renderer::Options(), executor);
    count = moved.positions.size();
  }
  state.counters["moved"] = static_cast<double>(count);
}

}  // namespace

BENCHMARK_CAPTURE(shade, chessboard_flat, "chessboard", Renderer::Normals::Flat)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(shade, bust_flat, "bust", Renderer::Normals::Flat)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(shade, bust_smooth, "bust", Renderer::Normals::Smooth)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(find_moved, bust, "bust")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(find_points, chessboard, "chessboard", ProjectionKind::Plane)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(find_points, grass, "grass", ProjectionKind::Plane)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(find_points, bust, "bust", ProjectionKind::Plane)->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(find_points, bust_surface, "bust", ProjectionKind::Surface)->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
