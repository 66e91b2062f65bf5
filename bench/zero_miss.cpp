// Rays that slip through a closed mesh: ours beside a general ray tracer's (Embree, default and robust).
//
// The mesh is a sphere of 358,800 triangles about (100, -57, 211), looked at from inside, so every ray must hit:
// through all vertices, through the middles of all edges and in random directions.
//
//   zero_miss [random rays, default 20000000]

#include <facemap/camera.h>
#include <facemap/scene.h>

#include <chrono>
#include <cinttypes>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <vector>

#include "support/embree_referee.h"
#include "support/scenes.h"

namespace {

using namespace facemap;

constexpr std::uint64_t kSeed = 0x5eed0041;

struct Rays {
  const char* name;
  std::uint64_t count;
  std::function<Vector(std::uint64_t)> direction;  // asked in order from 0
};

using Sees = std::function<bool(const Vector& direction)>;

std::uint64_t count_misses(const Rays& rays, const Sees& sees, double& nanoseconds) {
  const auto start = std::chrono::steady_clock::now();
  std::uint64_t misses = 0;
  for (std::uint64_t i = 0; i < rays.count; ++i) misses += !sees(rays.direction(i));
  const std::chrono::duration<double, std::nano> time = std::chrono::steady_clock::now() - start;
  nanoseconds = time.count() / static_cast<double>(rays.count);
  return misses;
}

std::vector<Vector> edge_middles(const Mesh& mesh) {
  std::vector<Vector> middles;
  for (const Corners& t : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = t[i], b = t[(i + 1) % 3];
      if (a < b) middles.push_back((mesh.positions[a] + mesh.positions[b]) * 0.5f);  // each edge once: two faces meet
    }
  }
  return middles;
}

}  // namespace

int main(int argc, char** argv) {
  const std::uint64_t random_rays = argc > 1 ? std::strtoull(argv[1], nullptr, 0) : 20'000'000;
  const DVector centre(100, -57, 211);
  const Scene scene(test_scenes::uv_sphere(600, 300, centre, 10));
  const Vector inside(centre + DVector(1.5, -2.25, 0.5));
  Camera::Options options;
  options.field_angle = 2 * 3.14159265358979323846;
  options.width = options.height = 1024;
  const Camera camera(scene, SpaceVector::looking_along(inside, DVector(0.2, 0.5, -1)), options);
  const EmbreeReferee embree(scene.mesh(), false), embree_robust(scene.mesh(), true);

  const std::vector<Vector>& vertices = scene.mesh().positions;
  const std::vector<Vector> middles = edge_middles(scene.mesh());
  Random random(kSeed);
  const Rays rays[] = {
      {"all vertices", vertices.size(), [&](std::uint64_t i) { return vertices[i] - inside; }},
      {"all edge midpoints", middles.size(), [&](std::uint64_t i) { return middles[i] - inside; }},
      {"random directions", random_rays,
       [&](std::uint64_t i) {
         if (i == 0) random = Random(kSeed);  // the same rays for all
         return Vector(random.direction());
       }},
  };
  const std::pair<const char*, Sees> tracers[] = {
      {"FaceMap", [&](const Vector& d) { return bool(camera.nearest(d)); }},
      {"Embree", [&](const Vector& d) { return embree.nearest(inside, d).face != kNoFace; }},
      {"Embree, robust", [&](const Vector& d) { return embree_robust.nearest(inside, d).face != kNoFace; }},
  };
  std::printf("%zu triangles about (100, -57, 211) from inside; seed %#" PRIx64 "\n", scene.face_count(), kSeed);
  bool all_hit = true;
  for (const Rays& set : rays) {
    for (const auto& [name, sees] : tracers) {
      double nanoseconds = 0;
      const std::uint64_t misses = count_misses(set, sees, nanoseconds);
      std::printf("%-20s %-16s %10" PRIu64 " of %10" PRIu64 " missed (%.2g %%), %.0f ns a ray\n", set.name, name,
                  misses, set.count, 100.0 * static_cast<double>(misses) / static_cast<double>(set.count), nanoseconds);
      std::fflush(stdout);
      if (&sees == &tracers[0].second && misses > 0) all_hit = false;
    }
  }
  return all_hit ? EXIT_SUCCESS : EXIT_FAILURE;
}
