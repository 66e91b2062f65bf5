#include "simd/floating_point_mode.h"

#include <facemap/camera.h>
#include <facemap/renderer.h>
#include <gtest/gtest.h>

namespace {

#if defined(__SSE2__)

constexpr unsigned kHostileMode = 0x1f80u | 0x8000u | 0x4000u | 0x0040u;  // flush, round up, denormals are zero

TEST(FloatingPointMode, AnswersAreTheSameInACallersHostileModeAndTheModeIsKept) {
  // A scene of denormal size: a flushed denormal would be a lost face.
  facemap::Mesh mesh;
  const float s = 1e-39f;
  mesh.positions = {{-4 * s, 0, -4 * s}, {-4 * s, 0, 4 * s}, {4 * s, 0, 4 * s}, {s, s, 0}, {s, s, s}, {0, s, s}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  const facemap::Scene scene(mesh);
  facemap::View view;
  view.position = {0, 10 * s, 0};
  view.look_at = {0, 0, 0};
  view.up = {0, 0, -1};
  facemap::Renderer::Options options;
  options.width = options.height = 24;
  options.planes = {facemap::Plane::Id, facemap::Plane::Depth, facemap::Plane::Lights};
  const std::vector<facemap::Light> lights{{{s, 3 * s, 0}}};
  const facemap::Image expected = facemap::Renderer(scene, view, lights, options).render();

  const unsigned saved = _mm_getcsr();
  _mm_setcsr(kHostileMode);
  const facemap::Image image = facemap::Renderer(scene, view, lights, options).render();
  const unsigned after = _mm_getcsr();
  _mm_setcsr(saved);
  EXPECT_EQ(after & ~0x3fu, kHostileMode & ~0x3fu) << "the low bits are exception flags";
  EXPECT_EQ(image.ids, expected.ids);
  EXPECT_EQ(image.depths, expected.depths);
  EXPECT_EQ(image.lights, expected.lights);
  EXPECT_TRUE(image.pixels == expected.pixels);
  int seen = 0;
  for (const facemap::FaceId id : image.ids) seen += id == 1;
  EXPECT_GT(seen, 0);
}

facemap::Vector downwards(int i) { return {0.01f * static_cast<float>(i) - 0.4f, -1, 0.1f}; }

// By themselves, not under a renderer that has set the mode already.
TEST(FloatingPointMode, ProjectionsAndTexelsAreTheSameInACallersHostileMode) {
  facemap::Mesh mesh;
  mesh.positions = {{-1, 0, -1}, {-1, 0, 1}, {1, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  const facemap::Scene scene(mesh);
  const auto frame = facemap::SpaceVector::looking_along({0, 1, 0}, facemap::DVector(1, -9, 3));
  const facemap::DVector denormal(0x1p-1030, -0x1p-1029, 0x1.8p-1029);
  for (const auto kind : {facemap::ProjectionKind::Surface, facemap::ProjectionKind::Plane}) {
    facemap::Camera::Options options;
    options.projection = kind;
    options.width = options.height = 300;
    for (const double field_angle : {0.7, 1.1, 2.3}) {
      options.field_angle = field_angle;
      const facemap::Camera expected(scene, frame, options);
      const auto expected_texel = expected.texel_of(denormal);
      const unsigned saved = _mm_getcsr();
      _mm_setcsr(kHostileMode);
      const facemap::Camera camera(scene, frame, options);
      const auto texel = camera.texel_of(denormal);
      std::vector<float> depths;
      for (int i = 0; i < 30; ++i) depths.push_back(camera.nearest(downwards(i)).depth);
      _mm_setcsr(saved);
      for (int i = 0; i < 30; ++i) EXPECT_EQ(depths[i], expected.nearest(downwards(i)).depth) << i;
      EXPECT_EQ(camera.projection().texel_angle(), expected.projection().texel_angle());
      ASSERT_EQ(texel.has_value(), expected_texel.has_value());
      EXPECT_TRUE(!texel || (texel->x == expected_texel->x && texel->y == expected_texel->y));
    }
  }
}

#endif

}  // namespace
