// Finding which points of a picture each light reaches: 1024 x 1024 samples, eight lights, one thread.

#include "picture/shadows.h"

#include <benchmark/benchmark.h>
#include <facemap/camera.h>
#include <facemap/generators.h>

#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "map/face_planes.h"
#include "math/elementary.h"
#include "math/exact_sign.h"
#include "picture/nearest_faces.h"
#include "picture/seen_points.h"

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
      clear_blocked(picture.scene, picture.lights[l], picture.seen.points, {plane.data(), 1, 0},
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
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
