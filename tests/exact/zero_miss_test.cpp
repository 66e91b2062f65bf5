// A closed mesh seen from inside has no crack: no ray leaves it, no light shines through it. The long run, beside
// a general ray tracer, is bench/zero_miss.

#include <facemap/camera.h>
#include <facemap/point_light.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <cstdio>

#include "support/scenes.h"

namespace {

using namespace facemap;

TEST(ZeroMiss, NoRayLeavesAClosedMeshAndNoLightShinesThroughIt) {
  constexpr std::uint64_t kSeed = 0x5eed0040;
  Random random(kSeed);
  const DVector centre(100, -57, 211);
  const Scene scene(test_scenes::uv_sphere(600, 300, centre, 10));
  ASSERT_EQ(scene.kept_faces().size(), 358800u);
  const Vector inside(centre + DVector(1.5, -2.25, 0.5));
  Camera::Options options;
  options.field_angle = 2 * M_PI;
  options.width = options.height = 768;
  const Camera camera(scene, SpaceVector::looking_along(inside, DVector(0.2, 0.5, -1)), options);
  const PointLight light(scene, inside);

  std::uint64_t rays = 0, misses = 0, leaks = 0;
  const auto shoot = [&](const Vector& d) {
    ++rays;
    misses += !camera.nearest(d);
    leaks += light.get_lighten_up(inside + 4.0f * d);  // three times as far as the mesh or more
  };
  const Mesh& mesh = scene.mesh();
  constexpr std::size_t kEvery = 5;  // the bench takes all
  for (std::size_t i = 0; i < mesh.positions.size(); i += kEvery) shoot(mesh.positions[i] - inside);
  for (std::size_t i = 0; i < mesh.triangles.size(); i += kEvery) {
    const Corners& t = mesh.triangles[i];
    for (int j = 0; j < 3; ++j) shoot((mesh.positions[t[j]] + mesh.positions[t[(j + 1) % 3]]) * 0.5f - inside);
  }
  for (int i = 0; i < 100'000; ++i) shoot(Vector(20.0 * random.direction()));
  std::printf("seed %#llx: %llu rays, %llu missed, %llu shone through\n", static_cast<unsigned long long>(kSeed),
              static_cast<unsigned long long>(rays), static_cast<unsigned long long>(misses),
              static_cast<unsigned long long>(leaks));
  EXPECT_EQ(misses, 0u);
  EXPECT_EQ(leaks, 0u);
}

}  // namespace
