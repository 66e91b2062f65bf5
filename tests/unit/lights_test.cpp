// Spot lights, directional lights, ranges and falloff: what they add and which points they reach.

#include <facemap/error.h>
#include <facemap/renderer.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

#include "map/light_lists.h"
#include "support/random.h"
#include "support/scenes.h"

namespace {

using namespace facemap;

// A square floor of side 8 in y = 0 and a small one of side 1 a unit above its middle.
Mesh floor_and_lid() {
  Mesh mesh;
  mesh.positions = {{-4, 0, -4},       {-4, 0, 4},       {4, 0, 4},       {4, 0, -4},
                    {-0.5f, 1, -0.5f}, {-0.5f, 1, 0.5f}, {0.5f, 1, 0.5f}, {0.5f, 1, -0.5f}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  return mesh;
}

// 80 x 80 pixels, of which each shows a tenth of a unit of the floor: pixel (40 + 10 x, 40 + 10 z) begins at (x, z).
View from_above() {
  View view;
  view.position = {0, 64, 0};
  view.look_at = {0, 0, 0};
  view.up = {0, 0, -1};
  view.projection = ProjectionKind::Plane;
  view.field_angle = 2 * std::atan2(4.0, 64.0);
  return view;
}

Image draw(const std::vector<Light>& lights, Renderer::Options options = {}) {
  static const Scene scene(floor_and_lid());
  options.width = options.height = 80;
  options.planes = {Plane::Id, Plane::Lights};
  return Renderer(scene, from_above(), lights, options).render();
}

// The pixel whose middle shows (x + 0.05, z + 0.05) of the floor.
std::size_t at(double x, double z) {
  return static_cast<std::size_t>(std::lround(40 + 10 * z)) * 80 + static_cast<std::size_t>(std::lround(40 + 10 * x));
}

Light sun(const Vector& direction) {
  Light light;
  light.kind = Light::Kind::Directional;
  light.direction = direction;
  return light;
}

Light spot(const Vector& position, double inner, double outer) {
  Light light;
  light.kind = Light::Kind::Spot;
  light.position = position;
  light.direction = {0, -3, 0};
  light.inner_angle = inner;
  light.outer_angle = outer;
  return light;
}

TEST(Lights, TheSunShinesByItsCosineAlone) {
  Light light = sun({3, -4, 0});
  light.color = {1, 0.5f, 0.25f};
  light.intensity = 2;
  light.position = {std::numeric_limits<float>::quiet_NaN(), 0, 0};  // it has none
  light.has_falloff = true;
  light.range = 0.5;
  Renderer::Options options;
  options.falloff = Renderer::Falloff::InverseSquare;
  const Image image = draw({light}, options);
  for (const std::size_t i : {at(-3, -3), at(3, 3)}) {
    EXPECT_FLOAT_EQ(image.pixels[i].r, 1.6f);
    EXPECT_FLOAT_EQ(image.pixels[i].g, 0.8f);
    EXPECT_FLOAT_EQ(image.pixels[i].b, 0.4f);
    EXPECT_EQ(image.lights[i], 1);
  }
}

// The lid of side 1 a unit up throws its shadow 3/4 of a unit to the right.
TEST(Lights, TheSunsShadowIsShiftedByTheDirection) {
  for (const auto strategy : {Renderer::Strategy::Lists, Renderer::Strategy::Transposed}) {
    Renderer::Options options;
    options.strategy = strategy;
    const Image image = draw({sun({3, -4, 0})}, options);
    EXPECT_EQ(image.lights[at(0.6, 0)], 0);
    EXPECT_EQ(image.lights[at(1.1, 0.4)], 0);
    EXPECT_EQ(image.lights[at(1.3, 0)], 1);
    EXPECT_EQ(image.lights[at(0.9, 0.5)], 1);
    EXPECT_EQ(image.lights[at(-0.7, 0)], 1);
    EXPECT_EQ(image.lights[at(0, 0)], 1) << "the lid itself";
    EXPECT_EQ(image.pixels[at(0.6, 0)].r, 0);
  }
}

TEST(Lights, TheSunFromBelowOrAlongTheFloorLeavesItDark) {
  const Image image = draw({sun({0, 1, 0}), sun({1, 0, 0})});
  EXPECT_EQ(image.lights[at(3, 3)], 0);
  EXPECT_EQ(image.pixels[at(3, 3)].r, 0);
}

// Lists that do not fit are made when they are asked, with the same bits, also for the next picture.
TEST(Lights, DirectionalOnesKeepWithinTheMapMemory) {
  std::vector<Light> lights;
  for (int i = 0; i < 11; ++i) lights.push_back(sun(Vector(i - 5, -4, 2 - i % 3)));
  lights.push_back(spot({-2, 2, -2}, 0.5, 1));
  const Scene scene(floor_and_lid());
  Renderer::Options options;
  options.strategy = Renderer::Strategy::Transposed;
  options.planes = {Plane::Id, Plane::Lights};
  for (const int threads : {1, 3}) {
    options.threads = threads;
    options.map_memory = 0;
    Renderer all(scene, from_above(), lights, options);
    const Image expected = all.render();
    const std::size_t of_one = LightLists(scene, lights[0], {}).memory_bytes();
    for (const std::size_t memory : {std::size_t{1}, 5 * of_one}) {
      options.map_memory = memory;
      Renderer some(scene, from_above(), lights, options);
      for (int picture = 0; picture < 2; ++picture) {
        const Image image = some.render();
        EXPECT_EQ(image.pixels, expected.pixels);
        EXPECT_EQ(image.lights, expected.lights);
        EXPECT_LT(some.statistics().map_bytes + 4 * of_one, all.statistics().map_bytes) << memory;
      }
    }
  }
}

TEST(Lights, ASpotFadesBetweenItsAngles) {
  const Vector position(-2, 2, -2);
  const double inner = 0.3, outer = 0.6;
  const Image image = draw({spot(position, inner, outer)});
  int within = 0, between = 0, beyond = 0;
  for (double x = -4; x < -0.7; x += 0.1) {
    const double dx = x + 0.05 + 2, dz = 0.05, distance = std::sqrt(dx * dx + dz * dz + 4);
    const double cosine = 2 / distance;
    const double t = (cosine - std::cos(outer)) / (std::cos(inner) - std::cos(outer));
    const double edge = std::min(std::max(t, 0.0), 1.0);
    const std::size_t i = at(x, -2);
    EXPECT_NEAR(image.pixels[i].r, cosine * edge * edge, 1e-3) << x;  // the camera is not infinitely far
    if (std::fabs(t) > 0.01) {
      EXPECT_EQ(image.lights[i], t > 0 ? 1 : 0) << x;
    }
    (t > 1 ? within : t > 0 ? between : beyond) += 1;
  }
  EXPECT_GT(within, 5);
  EXPECT_GT(between, 5);
  EXPECT_GT(beyond, 5);
}

TEST(Lights, ASpotsEdgeCanBeSharp) {
  const Image image = draw({spot({-2, 2, -2}, 0.5, 0.5)});
  const double radius = 2 * std::tan(0.5);
  EXPECT_FLOAT_EQ(image.pixels[at(-2, -2)].r, static_cast<float>(2 / std::sqrt(4 + 2 * 0.05 * 0.05)));
  EXPECT_EQ(image.lights[at(-2 + radius + 0.1, -2)], 0);
  EXPECT_EQ(image.lights[at(-2 + radius - 0.2, -2)], 1);
}

TEST(Lights, ARangeEndsWhatALightReaches) {
  Light light;
  light.position = {-2, 1, -2};
  light.range = 1.5;
  const Image image = draw({light});
  const double distance = std::sqrt(1 + 2 * 0.05 * 0.05), share = 1 - std::pow(distance / 1.5, 4);
  EXPECT_NEAR(image.pixels[at(-2, -2)].r, share / distance, 1e-3);
  EXPECT_EQ(image.lights[at(-1, -2)], 1);
  EXPECT_EQ(image.lights[at(-0.8, -2)], 0);
  EXPECT_EQ(image.pixels[at(-0.8, -2)].r, 0);
}

TEST(Lights, FalloffIsALightsOwnOrEverybodys) {
  Light own, none;
  own.position = none.position = {-2, 2, -2};
  own.has_falloff = true;
  none.color = {0, 1, 0};
  own.color = {1, 0, 0};
  const Color constant = draw({own, none}).pixels[at(-2, -2)];
  EXPECT_NEAR(constant.r, 0.25, 1e-3);
  EXPECT_NEAR(constant.g, 1, 2e-3);
  Renderer::Options options;
  options.falloff = Renderer::Falloff::InverseSquare;
  const Color squared = draw({own, none}, options).pixels[at(-2, -2)];
  EXPECT_EQ(squared.r, constant.r);
  EXPECT_EQ(squared.g, squared.r);
}

// The paper's renderer, sample by sample, has the same lights.
TEST(Lights, EdgeSamplingSeesTheSameLights) {
  const std::vector<Light> lights{sun({3, -4, 1}), spot({-2, 2, -2}, 0.2, 0.7), spot({2, 3, 1}, 0, 0.4)};
  Renderer::Options options;
  options.sampling = Renderer::Sampling::Edges;
  const Image edges = draw(lights, options);
  options.sampling = Renderer::Sampling::Grid;
  EXPECT_EQ(edges.lights, draw(lights, options).lights);
  EXPECT_EQ(edges.ids, draw(lights, options).ids);
}

TEST(Lights, RefusesWhatIsNoLight) {
  const auto refuses = [](const Light& light) { EXPECT_THROW(draw({light}), Error); };
  const float infinity = std::numeric_limits<float>::infinity();
  refuses(sun(Vector(0)));
  refuses(sun({0, infinity, 0}));
  Light light = spot({0, 2, 0}, 0.5, 0.4);
  refuses(light);
  refuses(spot({0, 2, 0}, -0.1, 0.4));
  refuses(spot({0, 2, 0}, 0, 3.2));
  refuses(spot({0, infinity, 0}, 0, 1));
  refuses(spot({0, 2, 0}, 0, std::nan("")));
  light = spot({0, 2, 0}, 0, 1);
  light.direction = Vector(0);
  refuses(light);
  light = spot({0, 2, 0}, 0, 1);
  light.range = 0;
  refuses(light);
  light.range = std::nan("");
  refuses(light);
}

// Two hundred and fifty bytes of light mask a point.
TEST(Lights, TwoThousandAddUp) {
  Random random(0x5eed0440);
  const test_scenes::TestScene test = test_scenes::make_scene(test_scenes::Kind::Patch, 200, random);
  const Scene scene(test.mesh);
  std::vector<Light> lights(2000);
  for (Light& light : lights) {
    light.position = Vector(DVector(test.centre) + 3 * test.radius * random.direction());
    light.intensity = 1.0f / 2048;
  }
  lights[777] = sun({1, -2, 3});
  View view;
  view = make_up_view(scene, view);
  Renderer::Options options;
  options.width = options.height = 64;
  options.planes = {Plane::Lights};
  options.strategy = Renderer::Strategy::Transposed;
  const Image transposed = Renderer(scene, view, lights, options).render();
  EXPECT_EQ(transposed.light_bytes(), 250);
  options.strategy = Renderer::Strategy::Lists;
  const Image listed = Renderer(scene, view, lights, options).render();
  EXPECT_EQ(transposed.lights, listed.lights);
  const auto lit = std::accumulate(listed.lights.begin(), listed.lights.end(), std::size_t{0});
  EXPECT_GT(lit, 0u);
  for (std::size_t i = 0; i < listed.pixels.size(); ++i) {
    ASSERT_EQ(listed.pixels[i].r, transposed.pixels[i].r);
    ASSERT_LE(listed.pixels[i].r, 2000.0f / 2048 + 1);
  }
}

}  // namespace
