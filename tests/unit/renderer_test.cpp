#include <facemap/error.h>
#include <facemap/renderer.h>
#include <gtest/gtest.h>

#include <cmath>

namespace {

using facemap::Color;
using facemap::Image;
using facemap::kNoFace;
using facemap::Light;
using facemap::Mesh;
using facemap::Plane;
using facemap::Renderer;
using facemap::Scene;
using facemap::Vector;
using facemap::View;

// A square floor of side 8 in y = 0 (faces 0, 1) and a small one of side 1 a unit above its middle (2, 3).
Mesh floor_and_lid() {
  Mesh mesh;
  mesh.positions = {{-4, 0, -4},       {-4, 0, 4},       {4, 0, 4},       {4, 0, -4},
                    {-0.5f, 1, -0.5f}, {-0.5f, 1, 0.5f}, {0.5f, 1, 0.5f}, {0.5f, 1, -0.5f}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  return mesh;
}

View from_above() {
  View view;
  view.position = {0, 10, 0};
  view.look_at = {0, 0, 0};
  view.up = {0, 0, -1};
  view.projection = facemap::ProjectionKind::Plane;
  return view;
}

Renderer::Options small(int size = 33) {
  Renderer::Options options;
  options.width = options.height = size;
  options.planes = {Plane::Id, Plane::Depth, Plane::Lights};
  return options;
}

std::size_t pixel(const Image& image, int x, int y) { return static_cast<std::size_t>(y * image.width + x); }

TEST(Renderer, RadianceIsColourTimesIntensityTimesCosine) {
  const Scene scene(floor_and_lid());
  const std::vector<Light> lights{{{0, 5, 0}, {1, 0.5f, 0.25f}, 0.5f}};
  const Image image = Renderer(scene, from_above(), lights, small()).render();
  const std::size_t centre = pixel(image, 16, 16);
  EXPECT_TRUE(image.ids[centre] == 2 || image.ids[centre] == 3);
  EXPECT_EQ(image.depths[centre], 9);
  EXPECT_FLOAT_EQ(image.pixels[centre].r, 0.5f);
  EXPECT_FLOAT_EQ(image.pixels[centre].g, 0.25f);
  EXPECT_FLOAT_EQ(image.pixels[centre].b, 0.125f);
  EXPECT_EQ(image.lights[centre], 1);
}

TEST(Renderer, InverseSquareFalloffDividesByTheSquaredDistance) {
  const Scene scene(floor_and_lid());
  Renderer::Options options = small();
  options.falloff = Renderer::Falloff::InverseSquare;
  const Image image = Renderer(scene, from_above(), {{{0, 5, 0}, {1, 1, 1}, 8}}, options).render();
  EXPECT_FLOAT_EQ(image.pixels[pixel(image, 16, 16)].r, 0.5f);
}

TEST(Renderer, LidThrowsItsShadowOnTheFloor) {
  // Seen from the side, the light above: the floor below the lid is dark, its corners are lit.
  const Scene scene(floor_and_lid());
  View view;
  view.position = {0, 0.5f, 20};
  view.look_at = {0, 0, 0};
  const facemap::Camera camera(scene, facemap::SpaceVector::looking_at(view.position, view.look_at), {});
  facemap::PointLight light(scene, {0, 3, 0});
  const auto lit = [&](const Vector& target) {
    const Vector d = target - view.position;
    const facemap::Camera::Hit hit = camera.nearest(d);
    EXPECT_TRUE(hit.face == 0 || hit.face == 1);
    return light.get_lighten_up(camera.surface_point(d, hit));
  };
  // The lid's half side of 0.5 at height 1 of 3 throws a square of half side 0.75.
  EXPECT_FALSE(lit({0, 0, 0}));
  EXPECT_FALSE(lit({0.74f, 0, 0.1f}));
  EXPECT_TRUE(lit({0.76f, 0, 0.1f}));
  EXPECT_TRUE(lit({-3, 0, 1}));
}

TEST(Renderer, LightsAreAddedAndEveryBitIsItsOwn) {
  const Scene scene(floor_and_lid());
  std::vector<Light> lights(11, Light{{0, 5, 0}, {0.125f, 0.125f, 0.125f}, 0.5f});
  lights[3].position = {0, -5, 0};  // below: dark
  const Image image = Renderer(scene, from_above(), lights, small()).render();
  EXPECT_EQ(image.light_bytes(), 2);
  const std::size_t centre = pixel(image, 16, 16);
  EXPECT_EQ(image.lights[2 * centre], 0xff & ~(1 << 3));
  EXPECT_EQ(image.lights[2 * centre + 1], 0x07);
  EXPECT_FLOAT_EQ(image.pixels[centre].r, 10 * 0.0625f);
}

TEST(Renderer, BackgroundIsWhereNoFaceIs) {
  const Scene scene(floor_and_lid());
  Renderer::Options options = small();
  options.background = {0.1f, 0.2f, 0.3f};
  View away = from_above();
  away.look_at = {0, 20, 0};
  const Image image = Renderer(scene, away, {{{0, 5, 0}}}, options).render();
  for (std::size_t i = 0; i < image.pixels.size(); ++i) {
    ASSERT_EQ(image.pixels[i], options.background);
    ASSERT_EQ(image.ids[i], kNoFace);
    ASSERT_EQ(image.depths[i], INFINITY);
    ASSERT_EQ(image.lights[i], 0);
  }
}

TEST(Renderer, PictureIsNotMirrored) {
  // One small face to the right of and above the centre as the camera sees it.
  Mesh mesh;
  mesh.positions = {{2, 1, 0}, {2.5f, 1, 0}, {2, 2, 0}};
  mesh.triangles = {{0, 1, 2}};
  const Scene scene(mesh);
  for (const auto kind : {facemap::ProjectionKind::Surface, facemap::ProjectionKind::Plane}) {
    View view;
    view.position = {0, 0, 10};
    view.look_at = {0, 0, 0};
    view.projection = kind;
    const Image image = Renderer(scene, view, {}, small(101)).render();
    int seen = 0;
    for (int y = 0; y < 101; ++y) {
      for (int x = 0; x < 101; ++x) {
        if (image.ids[pixel(image, x, y)] == kNoFace) continue;
        ++seen;
        EXPECT_GT(x, 50);
        EXPECT_LT(y, 50);
      }
    }
    EXPECT_GT(seen, 5);
  }
}

TEST(Renderer, EdgeSamplingEqualsTheGridWhereItSamples) {
  const Scene scene(floor_and_lid());
  Renderer::Options options = small(64);
  const std::vector<Light> lights{{{3, 5, 1}, {1, 1, 1}, 1}};
  options.samples = 4;
  const Image grid = Renderer(scene, from_above(), lights, options).render();
  options.sampling = Renderer::Sampling::Edges;
  Renderer renderer(scene, from_above(), lights, options);
  const Image edges = renderer.render();
  EXPECT_EQ(grid.ids, edges.ids);
  EXPECT_EQ(grid.lights, edges.lights);
  const auto upsampled = renderer.statistics().upsampled_pixels;
  EXPECT_GT(upsampled, 100u);
  EXPECT_LT(upsampled, 64u * 64u / 2);
  // Elsewhere a pixel shows one face under one set of lights: its centre differs from its mean by shading alone.
  std::size_t same = 0;
  for (std::size_t i = 0; i < grid.pixels.size(); ++i) {
    same += grid.pixels[i] == edges.pixels[i];
    ASSERT_NEAR(grid.pixels[i].r, edges.pixels[i].r, 1e-3);
  }
  EXPECT_GE(same, upsampled);
}

TEST(Renderer, PlanesAreThoseOfTheCentreRayWhateverTheSamples) {
  const Scene scene(floor_and_lid());
  const std::vector<Light> lights{{{3, 5, 1}}};
  Renderer::Options options = small();
  const Image one = Renderer(scene, from_above(), lights, options).render();
  options.samples = 2;
  const Image four = Renderer(scene, from_above(), lights, options).render();
  EXPECT_EQ(one.ids, four.ids);
  EXPECT_EQ(one.depths, four.depths);
  EXPECT_EQ(one.lights, four.lights);
}

TEST(Renderer, SmoothNormalsShadeRoundAndTheTerminatorFixLightsTheFold) {
  // A roof of two faces whose shared normals point straight up: with the light low on one side the far face looks
  // away from it, yet its interpolated normals do not.
  Mesh mesh;
  mesh.positions = {{-2, 0, 2}, {2, 0, 2}, {2, 0.4f, 0}, {-2, 0.4f, 0}, {2, 0, -2}, {-2, 0, -2}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {3, 2, 4}, {3, 4, 5}};
  mesh.normals = {{0, 1, 0}};
  mesh.normal_corners = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, {0, 0, 0}};
  const Scene scene(mesh);
  const std::vector<Light> lights{{{0, 3, 20}}};
  Renderer::Options options = small(65);
  const Image smooth = Renderer(scene, from_above(), lights, options).render();
  options.normals = Renderer::Normals::Flat;
  const Image flat = Renderer(scene, from_above(), lights, options).render();
  const std::size_t near_side = pixel(smooth, 32, 40), far_side = pixel(smooth, 32, 24);
  EXPECT_GT(flat.pixels[near_side].r, smooth.pixels[near_side].r) << "the face leans towards the light";
  EXPECT_EQ(flat.pixels[far_side].r, 0) << "the face is turned away";
  options.normals = Renderer::Normals::Smooth;
  options.shadow_terminator_fix = false;
  const Image unfixed = Renderer(scene, from_above(), lights, options).render();
  EXPECT_EQ(unfixed.pixels[far_side].r, 0);
  EXPECT_GT(smooth.pixels[far_side].r, 0) << "the lifted point sees the light over the ridge";
}

TEST(Renderer, LiftThatRoundingUndoesLeavesNoSpecks) {
  // A ball of smooth normals, offset so that float32 is coarse: near edges and vertices the lift is shorter than
  // its rounding, and a point rounded to below its own face would be black.
  constexpr int kRings = 64, kSegments = 128;
  Mesh mesh;
  for (int ring = 0; ring <= kRings; ++ring) {
    for (int segment = 0; segment < kSegments; ++segment) {
      const double a = 3.14159265358979 * ring / kRings, b = 2 * 3.14159265358979 * segment / kSegments;
      const Vector n(float(std::sin(a) * std::cos(b)), float(std::cos(a)), float(std::sin(a) * std::sin(b)));
      mesh.positions.push_back(Vector(100, -57, 211) + n);
      mesh.normals.push_back(n);
    }
  }
  const auto vertex = [](int ring, int segment) {
    return static_cast<std::uint32_t>(ring * kSegments + segment % kSegments);
  };
  for (int ring = 0; ring < kRings; ++ring) {
    for (int segment = 0; segment < kSegments; ++segment) {
      const auto a = vertex(ring, segment), b = vertex(ring + 1, segment), c = vertex(ring + 1, segment + 1),
                 d = vertex(ring, segment + 1);
      if (ring + 1 < kRings) mesh.triangles.push_back({a, c, b});
      if (ring > 0) mesh.triangles.push_back({a, d, c});
    }
  }
  mesh.normal_corners = mesh.triangles;
  const Scene scene(mesh);
  View view;
  view.position = {100, -57, 215};
  view.look_at = {100, -57, 211};
  const Image image = Renderer(scene, view, {{view.position}}, small(257)).render();
  int dark = 0, seen = 0;
  for (std::size_t i = 0; i < image.ids.size(); ++i) {
    if (image.ids[i] == kNoFace) continue;
    ++seen;
    dark += image.lights[i] == 0;
  }
  EXPECT_GT(seen, 10000);
  EXPECT_EQ(dark, 0) << "the light stands at the camera: every pixel is lit";
}

TEST(Renderer, NormalsAreBlendedByTheNearnessOfTheirCornersOnEitherSideOfTheFace) {
  Mesh mesh;
  mesh.positions = {{-3, 0, -3}, {-3, 0, 3}, {3, 0, 3}};
  mesh.triangles = {{0, 1, 2}};
  mesh.normals = {{0, 1, 0}, {3, 4, 0}, {0, 12, 5}};
  mesh.normal_corners = mesh.triangles;
  const std::vector<Light> lights{{{0, 1e6f, 0}}};  // cosines are the normals' y
  Renderer::Options options = small(129);
  options.shadow_terminator_fix = false;
  const Scene scene(mesh);
  const Image image = Renderer(scene, from_above(), lights, options).render();
  // 129 pixels are 20 tan(25 degrees) = 9.33 wide: 13.8 a unit, the corners 41.5 pixels from the middle.
  EXPECT_NEAR(image.pixels[pixel(image, 23 + 2, 23 + 4)].r, 1.0, 0.04);
  EXPECT_NEAR(image.pixels[pixel(image, 23 + 2, 105 - 4)].r, 4.0 / 5, 0.04);
  EXPECT_NEAR(image.pixels[pixel(image, 105 - 4, 105 - 2)].r, 12.0 / 13, 0.04);

  for (Vector& n : mesh.normals) n = -n;
  const Scene turned(mesh);
  EXPECT_TRUE(Renderer(turned, from_above(), lights, options).render().pixels == image.pixels);
}

TEST(Renderer, EdgeSamplingFindsAFaceBetweenPixelCentres) {
  Mesh mesh;  // pixels are 0.28 wide, the middle one's centre at the origin, samples at 0.035 and 0.106 from it
  mesh.positions = {{0.06f, 0, 0.06f}, {0.06f, 0, 0.2f}, {0.2f, 0, 0.06f}};
  mesh.triangles = {{0, 1, 2}};
  const Scene scene(mesh);
  Renderer::Options options = small();
  options.sampling = Renderer::Sampling::Edges;
  options.samples = 4;
  const Image image = Renderer(scene, from_above(), {{{0, 5, 0}}}, options).render();
  EXPECT_EQ(image.ids[pixel(image, 16, 16)], kNoFace);
  EXPECT_NEAR(image.pixels[pixel(image, 16, 16)].r, 1.0 / 16, 0.01);
}

TEST(Renderer, NormalsThatAreNotFiniteCountAsNone) {
  Mesh mesh = floor_and_lid();
  const std::vector<Light> lights{{{0, 5, 0}}};
  const Scene plain(mesh);
  const Image expected = Renderer(plain, from_above(), lights, small()).render();
  for (const Vector& normal : {Vector(NAN, 1, 0), Vector(0, 1, NAN), Vector(0, HUGE_VALF, 0)}) {
    mesh.normals = {normal};
    mesh.normal_corners.assign(mesh.face_count(), {0, 0, 0});
    const Scene scene(mesh);
    const Image image = Renderer(scene, from_above(), lights, small()).render();
    EXPECT_TRUE(image.pixels == expected.pixels);
    EXPECT_EQ(image.lights, expected.lights);
  }
}

TEST(Renderer, NormalsOfAFlatFaceLiftNothing) {
  // The plane's own normals: what rounding leaves below the corners' planes must not pass for a lift.
  Mesh mesh = floor_and_lid();
  const double c = std::cos(0.7), s = std::sin(0.7);
  for (Vector& v : mesh.positions) v = Vector(float(c * v.x - s * v.y + 3), float(s * v.x + c * v.y - 2), v.z + 1);
  mesh.normals = {Vector(float(-s), float(c), 0)};
  mesh.normal_corners.assign(4, {0, 0, 0});
  const Scene scene(mesh);
  View view;
  view.position = {3, 9, 2};
  view.look_at = {3, -2, 1};
  const std::vector<Light> lights{{{1, 4, 2}}, {{6, 3, -1}}, {{-2, -4, 0}}, {{9, -6, 3}}};
  Renderer::Options options = small(97);
  const Image smooth = Renderer(scene, view, lights, options).render();
  options.normals = Renderer::Normals::Flat;
  const Image flat = Renderer(scene, view, lights, options).render();
  EXPECT_EQ(smooth.lights, flat.lights);
}

// Masks are wanted or not: the colours are the same, though fewer lights are asked where they add nothing.
TEST(Renderer, LightsThatTheShadingNormalIsTurnedFromAddNothing) {
  Mesh mesh;  // a coarse ball with the normals of a round one
  constexpr int kRound = 12, kHigh = 7;
  for (int j = 0; j < kHigh; ++j) {
    for (int i = 0; i < kRound; ++i) {
      const double a = 2 * M_PI * i / kRound, b = M_PI * (j + 0.5) / kHigh;
      mesh.positions.push_back(
          Vector(float(std::sin(b) * std::cos(a)), float(std::cos(b)), float(std::sin(b) * std::sin(a))));
    }
  }
  for (std::uint32_t j = 0; j + 1 < kHigh; ++j) {
    for (std::uint32_t i = 0; i < kRound; ++i) {
      const std::uint32_t p = j * kRound + i, q = j * kRound + (i + 1) % kRound;
      mesh.triangles.push_back({p, q, p + kRound});
      mesh.triangles.push_back({q, q + kRound, p + kRound});
    }
  }
  mesh.normals = mesh.positions;
  mesh.normal_corners = mesh.triangles;
  const Scene scene(mesh);
  View view;
  view.position = {0, 1, 4};
  view.look_at = {0, 0, 0};
  const std::vector<Light> lights{{{1, 4, 2}}, {{6, 3, -1}}, {{-2, -4, 0}}, {{-9, 1, 3}}};
  Renderer::Options options = small(97);
  options.planes.remove(Plane::Lights);
  Renderer without(scene, view, lights, options);
  const Image colours = without.render();
  options.planes.add(Plane::Lights);
  Renderer with(scene, view, lights, options);
  EXPECT_EQ(with.render().pixels, colours.pixels);
  EXPECT_LT(without.statistics().light_queries, with.statistics().light_queries);
}

TEST(Renderer, ProgressRunsToTheEndAndCanStop) {
  const Scene scene(floor_and_lid());
  double last = -1;
  int calls = 0;
  Renderer renderer(scene, from_above(), {{{0, 5, 0}}}, small());
  renderer.render([&](double fraction, const char*) {
    last = fraction;
    ++calls;
    return true;
  });
  EXPECT_GT(last, 0.5);
  EXPECT_GT(calls, 4);
  EXPECT_THROW(renderer.render([](double, const char*) { return false; }), facemap::Error);
}

TEST(Renderer, RefusesOptionsOutOfRange) {
  const Scene scene(floor_and_lid());
  Renderer::Options options = small();
  options.samples = 0;
  EXPECT_THROW(Renderer(scene, from_above(), {}, options), facemap::Error);
  options = small();
  options.width = 0;
  EXPECT_THROW(Renderer(scene, from_above(), {}, options), facemap::Error);
  options = small();
  options.background.g = NAN;
  EXPECT_THROW(Renderer(scene, from_above(), {}, options), facemap::Error);
  EXPECT_THROW(Renderer(scene, from_above(), {{{0, 1, 0}, {1, 1, 1}, -1}}, small()), facemap::Error);
  EXPECT_THROW(Renderer(scene, from_above(), {{{0, INFINITY, 0}}}, small()), facemap::Error);
  View bad = from_above();
  bad.up = {0, 1, 0};
  EXPECT_THROW(Renderer(scene, bad, {}, small()), facemap::Error);
  bad = from_above();
  bad.field_angle = 4;
  EXPECT_THROW(Renderer(scene, bad, {}, small()), facemap::Error);
}

TEST(Renderer, MadeUpViewFitsTheSceneAndMadeUpLightsStandAround) {
  const Scene scene(floor_and_lid());
  const View view = facemap::make_up_view(scene);
  const facemap::DVector to_centre = scene.centre() - facemap::DVector(view.position);
  const double distance = std::sqrt(to_centre.x * to_centre.x + to_centre.y * to_centre.y + to_centre.z * to_centre.z);
  EXPECT_NEAR(scene.bounding_radius() / distance, std::sin(view.field_angle / 2), 1e-6);
  View wide;
  wide.field_angle = 3.1;
  const auto from_wide = scene.centre() - facemap::DVector(facemap::make_up_view(scene, wide).position);
  const double squared = from_wide.x * from_wide.x + from_wide.y * from_wide.y + from_wide.z * from_wide.z;
  EXPECT_NEAR(std::sqrt(squared), 1.05 * scene.bounding_radius(), 1e-5) << "outside the sphere, however wide the field";
  const auto lights = facemap::make_up_lights(scene);
  ASSERT_EQ(lights.size(), 8u);
  EXPECT_NEAR(lights[0].position.x - scene.centre().x, 1.6 * scene.bounding_radius(), 1e-5);
  EXPECT_NEAR(lights[1].position.y - scene.centre().y, 1.3 * scene.bounding_radius(), 1e-5);
  EXPECT_EQ(lights[0].intensity, 0.25f);
}

}  // namespace
