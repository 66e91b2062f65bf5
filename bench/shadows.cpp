// Finding which points of a picture each light reaches: 1024 x 1024 samples, eight lights, one thread; and the kernels
// that do it.

#include "picture/shadows.h"

#include <benchmark/benchmark.h>
#include <facemap/camera.h>
#include <facemap/generators.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "map/face_planes.h"
#include "math/elementary.h"
#include "math/exact_sign.h"
#include "picture/gnomonic.h"
#include "picture/light_bounds.h"
#include "picture/nearest_faces.h"
#include "picture/point_list.h"
#include "picture/seen_points.h"
#include "picture/shadow_faces.h"
#include "picture/shadow_points.h"
#include "simd/shadow_planes.h"

namespace {

using namespace facemap;

constexpr int kSize = 1024;  // pixels a side

struct Picture {
  explicit Picture(GeneratedScene made)
      : scene(std::move(made.mesh)),
        grid{SpaceVector::looking_at(made.camera_position, made.look_at, made.up),
             Projection(ProjectionKind::Plane, made.field_angle_deg * elementary::kPi / 180, kSize, kSize), 1} {
    for (const auto& light : made.lights) lights.push_back(light.position);
    const Executor alone(1);
    seen = find_seen_points(scene, grid, find_nearest_faces(scene, grid, alone), lights, alone);
  }

  TruePoint point(std::size_t i) const {
    const auto sample = static_cast<int>(seen.points.samples[i]);
    const Triangle face = triangle_of(scene, seen.points.faces[i]);
    const Vector& K = grid.frame.position();
    return {K, grid.direction(sample % grid.columns(), sample / grid.columns()), face, side(face, K)};
  }

  Scene scene;
  SampleGrid grid;
  std::vector<Vector> lights;
  SeenPoints seen;
};

const Picture& picture_of(const std::string& name, int detail) {
  static std::map<std::pair<std::string, int>, std::unique_ptr<Picture>> pictures;
  auto& picture = pictures[{name, detail}];
  if (picture == nullptr) picture = std::make_unique<Picture>(generate_scene(name, detail));
  return *picture;
}

// All lights of a picture. `skip`: as if every face belonged to a closed part.
void clear_all(benchmark::State& state, const std::string& name, int detail, bool skip) {
  const Picture& picture = picture_of(name, detail);
  const std::vector<std::uint8_t> entries(picture.scene.face_count(), 1);
  ShadowScratch scratch;
  Counters counters;
  std::size_t queries = 0, asked = 0, blocked = 0;
  const std::size_t points = picture.seen.points.size();
  std::vector<std::uint8_t> plane(points);
  for (auto _ : state) {
    for (std::size_t l = 0; l < picture.lights.size(); ++l) {
      state.PauseTiming();
      for (std::size_t i = 0; i < points; ++i) {
        plane[i] = picture.seen.masks[i * picture.seen.stride + l / 8] >> (l % 8) & 1;
        queries += plane[i];
      }
      state.ResumeTiming();
      const auto exactly = [&](std::size_t point, std::uint32_t face, int s) {
        ++asked;
        return blocks(triangle_of(picture.scene, face), s, picture.lights[l], picture.point(point));
      };
      clear_blocked(picture.scene, picture.lights[l], picture.seen.points, {plane.data(), plane.data(), 1, 0},
                    skip ? entries.data() : nullptr, exactly, scratch, &counters);
      benchmark::DoNotOptimize(plane.data());
      state.PauseTiming();
      for (const std::uint8_t lit : plane) blocked += lit == 0;
      state.ResumeTiming();
    }
  }
  const auto per_light = [&](std::uint64_t count) {
    return static_cast<double>(count) /
           (static_cast<double>(state.iterations()) * static_cast<double>(picture.lights.size()));
  };
  state.counters["queries"] = per_light(queries);
  state.counters["blocks"] = per_light(counters.by_float / 16);
  state.counters["exactly"] = per_light(asked);
  state.counters["MB"] = static_cast<double>(scratch.memory_bytes()) / 1e6;
  state.counters["lit"] = per_light(points * state.iterations() * picture.lights.size() - blocked);
}

// ---- kernels, on the chessboard and its first light

struct Kernels {
  Kernels() : picture(picture_of("chessboard", 1)), points(picture.seen.points), light(picture.lights[0]) {
    const Scene& scene = picture.scene;
    const DVector to_light(light);
    frame = *frame_towards(light, {DVector(scene.lower()) - to_light, DVector(scene.upper()) - to_light}, points.error);
    wanted.assign(points.size(), 1);
    for (int i = 0; i < 3; ++i) {
      for (int k = 0; k < 3; ++k) {
        transform.matrix[i][k] = frame.rows[i][k] * points.step;
        transform.offset[i] += frame.rows[i][k] * (points.origin - to_light)[k];
      }
    }
    std::vector<std::uint32_t> rest;
    sort(rest);
    places.resize(3 * (scene.mesh().positions.size() + 16));
    project();
    corners.resize(simd::kShadowFaces / 16);
    for (std::size_t f = 0; f < simd::kShadowFaces; ++f) {
      for (int k = 0; k < 3; ++k) {
        for (int axis = 0; axis < 3; ++axis) corners[f / 16].of[k][axis][f % 16] = scene.mesh().vertex(f, k)[axis];
      }
    }
  }

  simd::ListedPoints list() {
    const std::size_t count = points.size();
    memory.start();
    simd::ListedPoints all = list_in(memory, count);
    simd::list_wanted(arrays_of(points), {wanted.data(), 1, 1}, all);
    return all;
  }

  void sort(std::vector<std::uint32_t>& rest) {
    sorted.sort(list(), transform, points.faces.data(), picture.scene.face_count(), memory, rest);
  }

  void project() {
    const std::vector<Vector>& positions = picture.scene.mesh().positions;
    simd::project_vertices(frame, &positions[0].x, positions.size(), places.data());
  }

  void sift(std::size_t first) {
    const Mesh& mesh = picture.scene.mesh();
    sifted.count = 0;
    simd::sift_faces({mesh.triangles[0].data(), places.data(), nullptr, first,
                      std::min(first + simd::kShadowFaces, mesh.face_count()), sorted.raster(), &sorted.farthest(),
                      sorted.occupied()},
                     sifted);
  }

  const Picture& picture;
  const AskedPoints& points;
  const Vector light;
  simd::ShadowFrame frame;
  std::vector<std::uint8_t> wanted;
  simd::PointTransform transform{};
  WorkingMemory memory;
  ShadowPoints sorted;
  std::vector<float> places;
  simd::SiftedFaces sifted;
  std::vector<simd::ShadowCorners> corners;
};

void list_wanted(benchmark::State& state) {
  Kernels k;
  for (auto _ : state) benchmark::DoNotOptimize(k.list().x);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(k.points.size()));
}

void sort_points(benchmark::State& state) {
  Kernels k;
  std::vector<std::uint32_t> rest;
  for (auto _ : state) k.sort(rest);
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(k.points.size()));
}

void project_vertices(benchmark::State& state) {
  Kernels k;
  for (auto _ : state) k.project();
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(k.picture.scene.mesh().positions.size()));
}

void sift_faces(benchmark::State& state) {
  Kernels k;
  const std::size_t faces = k.picture.scene.face_count();
  for (auto _ : state) {
    for (std::size_t first = 0; first < faces; first += simd::kShadowFaces) k.sift(first);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(faces));
}

void set_up_planes(benchmark::State& state) {
  const Kernels k;
  std::vector<simd::ShadowPlanes> planes(k.corners.size());
  std::vector<std::int8_t> sides(simd::kShadowFaces);
  for (auto _ : state) {
    simd::set_up_planes(k.frame, k.corners.data(), k.corners.size(), 1, planes.data(), sides.data());
    benchmark::DoNotOptimize(sides.data());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(sides.size()));
}

// From vertices to marked points; items are blocks of sixteen points held against a face.
void all_faces(benchmark::State& state) {
  Kernels k;
  const Scene& scene = k.picture.scene;
  ShadowFaces faces;
  Counters counters;
  const auto never = [](std::size_t, std::uint32_t, int) { return false; };
  std::vector<std::uint32_t> rest;
  for (auto _ : state) {
    state.PauseTiming();
    k.sort(rest);
    state.ResumeTiming();
    faces.run({scene, k.light, k.frame, 1, nullptr, nullptr, nullptr, never}, k.sorted, counters);
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(counters.by_float / 16));
}

// The light's bounds from the scene; items are faces.
void find_bounds(benchmark::State& state) {
  const Kernels k;
  const std::vector<FaceNeighbours> neighbours = find_face_neighbours(k.picture.scene);
  for (auto _ : state) {
    benchmark::DoNotOptimize(LightBounds::find(k.picture.scene, k.light, nullptr, neighbours).has_value());
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(k.picture.scene.face_count()));
}

void find_neighbours(benchmark::State& state) {
  const Kernels k;
  for (auto _ : state) benchmark::DoNotOptimize(find_face_neighbours(k.picture.scene).data());
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(k.picture.scene.face_count()));
}

// What the bounds leave open, of all points of the picture.
void decide_points(benchmark::State& state) {
  const Kernels k;
  const auto bounds = LightBounds::find(k.picture.scene, k.light, nullptr, find_face_neighbours(k.picture.scene));
  std::vector<std::uint8_t> dark(k.points.size() + 64);
  std::vector<std::uint32_t> open(k.points.size() + 64);
  const simd::TexelBounds texels = bounds.value().texels();
  const simd::PointsToProject from{
      k.transform, k.points.x.data(), k.points.y.data(), k.points.z.data(), k.wanted.data(), 1, k.points.size()};
  for (auto _ : state) {
    const auto counts = simd::decide_points(from, texels, 0, k.points.size(), dark.data(), open.data());
    benchmark::DoNotOptimize(counts.open);
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(k.points.size()));
}

void add(const std::string& name, int detail) {
  for (const bool skip : {false, true}) {
    benchmark::RegisterBenchmark((name + std::to_string(detail) + (skip ? "/exits" : "/all")).c_str(),
                                 [=](benchmark::State& state) { clear_all(state, name, detail, skip); })
        ->Unit(benchmark::kMillisecond);
  }
}

}  // namespace

int main(int argc, char** argv) {
  for (const std::string& name : generator_names()) add(name, 1);
  add("chessboard", 4);
  benchmark::RegisterBenchmark("list_wanted", list_wanted)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("sort_points", sort_points)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("find_neighbours", find_neighbours)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("find_bounds", find_bounds)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("decide_points", decide_points)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("project_vertices", project_vertices)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("sift_faces", sift_faces)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("set_up_planes", set_up_planes)->Unit(benchmark::kMillisecond);
  benchmark::RegisterBenchmark("all_faces", all_faces)->Unit(benchmark::kMillisecond);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
