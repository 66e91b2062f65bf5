#include <facemap/camera.h>
#include <facemap/error.h>
#include <facemap/raster.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "math/elementary.h"
#include "render/scan_lines.h"
#include "render/screen_transform.h"
#include "support/scenes.h"

namespace {

using facemap::Camera;
using facemap::Color;
using facemap::DVector;
using facemap::Error;
using facemap::FaceId;
using facemap::fill_scan_lines;
using facemap::Image;
using facemap::kNoFace;
using facemap::Light;
using facemap::Mesh;
using facemap::ProjectionKind;
using facemap::RasterOptions;
using facemap::render_raster;
using facemap::Scene;
using facemap::ScreenSamples;
using facemap::SpaceVector;
using facemap::Vector;
using facemap::View;
using facemap::elementary::kPi;

// Rounding of a handful of products of numbers up to 2^10.
constexpr double kRounding = 0x1p-40;

View plane_view(const Vector& position, const Vector& look_at, double field_angle) {
  View view;
  view.position = position;
  view.look_at = look_at;
  view.field_angle = field_angle;
  view.projection = ProjectionKind::Plane;
  return view;
}

RasterOptions options(int width, int height) {
  RasterOptions result;
  result.width = width;
  result.height = height;
  result.want_ids = result.want_depths = true;
  return result;
}

Mesh triangle(const Vector& a, const Vector& b, const Vector& c) {
  Mesh mesh;
  test_scenes::add_triangle(mesh, a, b, c);
  return mesh;
}

// ---- eq. (1), (2) ---------------------------------------------------------------------------------------

TEST(ScreenTransform, PutsTheFieldAngleOnTheUpperEdge) {
  // With cot(theta) as printed, 90 degrees would send every point to the middle.
  for (const double field_deg : {50.0, 90.0, 120.0, 170.0}) {
    const double half = field_deg * kPi / 360;
    const glm::dmat4 M = facemap::perspective_matrix(field_deg * kPi / 180, 2, 1, 100);
    const DVector top = facemap::screen_from_local({0, 5 * std::tan(half), 5}, M);
    EXPECT_NEAR(top.y, 1, kRounding) << field_deg;
    const DVector right = facemap::screen_from_local({10 * std::tan(half), 0, 5}, M);
    EXPECT_NEAR(right.x, 1, kRounding) << field_deg;
  }
}

TEST(ScreenTransform, DepthIsZeroAtTheNearPlaneAndOneAtTheFar) {
  const glm::dmat4 M = facemap::perspective_matrix(1, 1, 2, 50);
  EXPECT_NEAR(facemap::screen_from_local({0, 0, 2}, M).z, 0, kRounding);
  EXPECT_NEAR(facemap::screen_from_local({3, 1, 50}, M).z, 1, kRounding);
  for (const double z : {2.0, 3.0, 10.0, 49.0}) {
    EXPECT_NEAR(facemap::sight_distance(facemap::screen_from_local({1, -1, z}, M).z, 2, 50), z, kRounding * z);
  }
}

TEST(ScreenTransform, ScreenCornersAreThePictures) {
  const glm::dmat4 S = facemap::screen_matrix(640, 480);
  EXPECT_EQ(facemap::screen_from_local({-1, 1, 0.25}, S), DVector(0, 0, 0.25));
  EXPECT_EQ(facemap::screen_from_local({1, -1, 0.25}, S), DVector(640, 480, 0.25));
  EXPECT_EQ(facemap::screen_from_local({0, 0, 0}, S), DVector(320, 240, 0));
}

TEST(ScreenTransform, AgreesWithTheProjectionOfMaps) {
  const facemap::Projection projection(ProjectionKind::Plane, 1.2, 640, 480);
  const glm::dmat4 MS = facemap::perspective_matrix(1.2, 640.0 / 480, 0.1, 100) * facemap::screen_matrix(640, 480);
  Random random(51);
  for (int i = 0; i < 1000; ++i) {
    const DVector local(random.between(-5.0, 5.0), random.between(-5.0, 5.0), random.between(0.5, 50.0));
    const DVector a = facemap::screen_from_local(local, MS);
    const facemap::MapPoint b = projection.map_from_local(local);
    EXPECT_NEAR(a.x, b.x, 0x1p-30);
    EXPECT_NEAR(a.y, b.y, 0x1p-30);
  }
}

// ---- Alg. 1 and eq. (3) ---------------------------------------------------------------------------------

std::string drawn(const ScreenSamples& samples) {
  std::string text;
  for (int row = 0; row < samples.height; ++row) {
    for (int column = 0; column < samples.width; ++column) {
      const FaceId face = samples.faces[static_cast<std::size_t>(row) * samples.width + column];
      text += face == kNoFace ? '.' : static_cast<char>('a' + face);
    }
    text += '\n';
  }
  return text;
}

TEST(ScanLines, FillsFromTheLeftCrossingToTheRight) {
  ScreenSamples samples(6, 5, 0.5, 0.5);
  fill_scan_lines(std::vector<DVector>{{1, 0, 0.5}, {5, 4, 0.5}, {1, 4, 0.5}}, 0, {}, samples);
  EXPECT_EQ(drawn(samples),
            "......\n"
            ".a....\n"
            ".aa...\n"
            ".aaa..\n"
            "......\n");
}

TEST(ScanLines, NeighboursLeaveNoGapAndShareNoSample) {
  Random random(52);
  for (int i = 0; i < 200; ++i) {
    const DVector p(random.between(0.0, 16.0), random.between(0.0, 16.0), 0.5);
    const DVector corners[] = {{-1, -1, 0.5}, {17, -1, 0.5}, {17, 17, 0.5}, {-1, 17, 0.5}};
    std::vector<int> hits(16 * 16, 0);
    for (int side = 0; side < 4; ++side) {
      ScreenSamples samples(16, 16, 0.5, 0.5);
      fill_scan_lines(std::vector<DVector>{corners[side], corners[(side + 1) % 4], p}, 0, {}, samples);
      for (std::size_t k = 0; k < hits.size(); ++k) hits[k] += samples.faces[k] != kNoFace;
    }
    for (const int count : hits) ASSERT_EQ(count, 1) << "case " << i;
  }
}

TEST(ScanLines, SamplesOnEdgesBelongToTheRightAndTheLower) {
  ScreenSamples samples(4, 4, 0.5, 0.5);
  fill_scan_lines(std::vector<DVector>{{0.5, 0.5, 0}, {2.5, 0.5, 0}, {2.5, 2.5, 0}, {0.5, 2.5, 0}}, 0, {}, samples);
  EXPECT_EQ(drawn(samples), "aa..\naa..\n....\n....\n");
}

TEST(ScanLines, TheNearerFaceWinsInWhicheverOrderAndTheFirstOfEqualOnes) {
  const std::vector<DVector> low{{0, 0, 0.2}, {4, 0, 0.2}, {4, 4, 0.2}, {0, 4, 0.2}};
  const std::vector<DVector> slope{{0, 0, 0}, {4, 0, 0.4}, {4, 4, 0.4}, {0, 4, 0}};
  for (const bool low_first : {true, false}) {
    ScreenSamples samples(4, 1, 0.5, 0.5);
    fill_scan_lines(low_first ? low : slope, low_first ? 0 : 1, {}, samples);
    fill_scan_lines(low_first ? slope : low, low_first ? 1 : 0, {}, samples);
    EXPECT_EQ(drawn(samples), "bbaa\n");
  }
  ScreenSamples samples(4, 1, 0.5, 0.5);
  fill_scan_lines(low, 3, {}, samples);
  fill_scan_lines(low, 1, {}, samples);
  EXPECT_EQ(drawn(samples), "dddd\n");
}

TEST(ScanLines, ClipsToTheScreenAndTheFarPlaneAndTheMask) {
  ScreenSamples samples(3, 2, 0.5, 0.5);
  fill_scan_lines(std::vector<DVector>{{-1e12, -1e12, 0.5}, {1e12, -1e12, 0.5}, {0, 1e12, 0.5}}, 0, {1, 0, 1, 0, 1, 0},
                  samples);
  EXPECT_EQ(drawn(samples), "a.a\n.a.\n");
  fill_scan_lines(std::vector<DVector>{{-9, -9, 1}, {9, -9, 1}, {0, 99, 1}}, 1, {}, samples);
  EXPECT_EQ(drawn(samples), "a.a\n.a.\n");
}

// ---- the picture ----------------------------------------------------------------------------------------

TEST(Raster, DepthIsTheDistanceAlongTheRay) {
  const Scene scene(triangle(Vector(-50, -50, -4), Vector(50, -50, -4), Vector(0, 90, -4)));
  const View view = plane_view(Vector(0), Vector(0, 0, -1), kPi / 2);
  const Image image = render_raster(scene, view, {}, options(32, 16));
  const facemap::Projection projection(ProjectionKind::Plane, kPi / 2, 32, 16);
  for (int i = 0; i < 32 * 16; ++i) {
    const DVector d = projection.local_from_map({i % 32 + 0.5, i / 32 + 0.5});
    ASSERT_EQ(image.ids[i], 0);
    // 2^-32 for a depth at 2^-20 of the far plane (see kNearShare), 2^-24 for the float32.
    EXPECT_NEAR(image.depths[i], 4 / d.z, 4 / d.z * 0x1p-23);
  }
}

TEST(Raster, ShadesWithTheCosineAndLeavesFacesTurnedFromTheLightDark) {
  const Scene scene(triangle(Vector(-50, -50, -4), Vector(50, -50, -4), Vector(0, 90, -4)));
  const View view = plane_view(Vector(0), Vector(0, 0, -1), kPi / 2);
  Light light;
  light.position = Vector(3, 0, 0);
  light.color = Color{1, 0.5f, 0.25f};
  light.intensity = 2;
  const Image image = render_raster(scene, view, {light}, options(33, 33));
  const std::size_t middle = 33 * 16 + 16;
  const double cosine = 4 / 5.0;
  EXPECT_NEAR(image.pixels[middle].r, 2 * cosine, 0x1p-20);
  EXPECT_NEAR(image.pixels[middle].g, cosine, 0x1p-20);
  EXPECT_NEAR(image.pixels[middle].b, cosine / 2, 0x1p-20);
  light.position.z = -8;
  EXPECT_EQ(render_raster(scene, view, {light}, options(33, 33)).pixels[middle], (Color{0, 0, 0}));
  // The camera's own light: straight ahead it meets the face head-on.
  EXPECT_NEAR(render_raster(scene, view, {}, options(33, 33)).pixels[middle].r, 1, 0x1p-20);
}

TEST(Raster, BackgroundIsWhereNothingIs) {
  const Scene scene(triangle(Vector(-1, -1, 5), Vector(1, -1, 5), Vector(0, 1, 5)));  // behind the camera
  RasterOptions o = options(4, 4);
  o.background = Color{0.25f, 0.5f, 0.75f};
  o.edge_samples = 3;
  const Image image = render_raster(scene, plane_view(Vector(0), Vector(0, 0, -1), 1), {}, o);
  for (int i = 0; i < 16; ++i) {
    EXPECT_EQ(image.pixels[i], o.background);
    EXPECT_EQ(image.ids[i], kNoFace);
    EXPECT_EQ(image.depths[i], std::numeric_limits<float>::infinity());
  }
}

TEST(Raster, DividesEdgePixelsAlone) {
  // A wall whose edge cuts column 8 in two, from above at a quarter to below at three quarters.
  const Scene scene(triangle(Vector(-100, -100, -1), Vector(0.53125f + 100, -100, -1), Vector(-100, 100.53125f, -1)));
  const View view = plane_view(Vector(0), Vector(0, 0, -1), kPi / 2);
  RasterOptions o = options(16, 16);
  const Image plain = render_raster(scene, view, {}, o);
  o.edge_samples = 4;
  const Image smooth = render_raster(scene, view, {}, o);
  EXPECT_EQ(plain.ids, smooth.ids);
  int changed = 0;
  for (int i = 0; i < 16 * 16; ++i) {
    const int x = i % 16, y = i / 16;
    const auto same_as = [&](int dx, int dy) {
      const bool outside = x + dx < 0 || x + dx > 15 || y + dy < 0 || y + dy > 15;
      return outside || plain.ids[i + dx + 16 * dy] == plain.ids[i];
    };
    const bool is_edge = !(same_as(1, 0) && same_as(-1, 0) && same_as(0, 1) && same_as(0, -1));
    if (!is_edge) {
      EXPECT_EQ(plain.pixels[i], smooth.pixels[i]) << x << ' ' << y;
    } else if (!(plain.pixels[i] == smooth.pixels[i])) {
      ++changed;
    }
  }
  EXPECT_GT(changed, 10);
}

TEST(Raster, MeanOfAnEdgePixelIsTheShareThatTheFaceCovers) {
  // The face ends at 8.6 of 16 pixels, between the second and the third of four samples of pixel 8.
  const float end = 0.075f;  // (8.6 - 8) / 8 at distance 1
  Mesh left = triangle(Vector(-100, -100, -1), Vector(end, -100, -1), Vector(end, 100, -1));
  test_scenes::add_triangle(left, Vector(-100, -100, -1), Vector(end, 100, -1), Vector(-100, 100, -1));
  Mesh upper = triangle(Vector(-100, -end, -1), Vector(100, -end, -1), Vector(100, 100, -1));
  test_scenes::add_triangle(upper, Vector(-100, -end, -1), Vector(100, 100, -1), Vector(-100, 100, -1));
  RasterOptions o = options(16, 16);
  o.edge_samples = 4;
  Light light;
  light.position = Vector(0, 0, 1e9f);  // head-on everywhere
  const View view = plane_view(Vector(0), Vector(0, 0, -1), kPi / 2);
  const Image columns = render_raster(Scene(left), view, {light}, o);
  const Image rows = render_raster(Scene(upper), view, {light}, o);
  for (int i = 0; i < 16; ++i) {
    EXPECT_NEAR(columns.pixels[i * 16 + 8].r, 0.5, 0x1p-20) << i;
    EXPECT_NEAR(rows.pixels[8 * 16 + i].r, 0.5, 0x1p-20) << i;
  }
}

TEST(Raster, AFaceSeenEdgeOnIsNotDrawn) {
  // Faces in the plane x = 3y, level in the picture and through the middle of a row of pixels: rounding gives their
  // images a height, which no row may show.
  Random random(54);
  View view = plane_view(Vector(0), Vector(3, 1, 0.7f), 1);
  view.up = Vector(1, -3, 0);
  for (int i = 0; i < 500; ++i) {
    const auto corner = [&] {
      const auto y = static_cast<float>(random.between(32, 128)) / 64,
                 z = static_cast<float>(random.between(-1.0, 2.0));
      return Vector(3 * y, y, z);  // exactly
    };
    const Mesh mesh = triangle(corner(), corner(), corner());
    for (const FaceId face : render_raster(Scene(mesh), view, {}, options(33, 33)).ids) ASSERT_EQ(face, kNoFace) << i;
  }
}

TEST(Raster, AgreesWithTheExactCameraButForEdges) {
  Random random(53);
  int pixels = 0, different = 0, inside = 0;
  for (int i = 0; i < 40; ++i) {
    const auto kind = i % 2 == 0 ? test_scenes::Kind::Soup : test_scenes::Kind::Patch;
    const test_scenes::TestScene made = test_scenes::make_scene(kind, 60, random);
    const Scene scene(made.mesh);
    const Vector position(DVector(made.centre) + random.direction() * (made.radius * random.between(0.5, 3.0)));
    const View view = plane_view(position, made.centre, i % 4 < 2 ? 1.0 : 2.0);
    RasterOptions o = options(64, 48);
    const Image image = render_raster(scene, view, {}, o);
    Camera::Options c;
    c.projection = ProjectionKind::Plane;
    c.field_angle = view.field_angle;
    c.width = o.width;
    c.height = o.height;
    const Camera camera(scene, SpaceVector::looking_at(view.position, view.look_at, view.up), c);
    for (int k = 0; k < o.width * o.height; ++k) {
      const Vector d = camera.direction_through({k % o.width + 0.5, k / o.width + 0.5});
      const Camera::Hit hit = camera.nearest(d);
      ++pixels;
      if (hit.face != image.ids[k]) {
        ++different;
      } else if (hit) {
        ++inside;
        EXPECT_NEAR(image.depths[k], hit.depth, hit.depth * 1e-4) << "scene " << i << " pixel " << k;
      }
    }
  }
  std::printf("raster and exact camera differ in %d of %d pixels\n", different, pixels);
  EXPECT_GT(inside, pixels / 8);
  // Only pixels whose centre an edge meets to within rounding can differ, or where two faces intersect.
  EXPECT_LE(different, pixels / 10000);
}

TEST(Raster, RefusesWhatItCannotDraw) {
  const Scene scene(triangle(Vector(-1, -1, -5), Vector(1, -1, -5), Vector(0, 1, -5)));
  const View view = plane_view(Vector(0), Vector(0, 0, -1), 1);
  const auto refused = [&](const View& v, RasterOptions o) { EXPECT_THROW(render_raster(scene, v, {}, o), Error); };
  View surface = view;
  surface.projection = ProjectionKind::Surface;
  refused(surface, options(8, 8));
  View wide = view;
  wide.field_angle = kPi;
  refused(wide, options(8, 8));
  refused(view, options(0, 8));
  RasterOptions o = options(8, 8);
  o.edge_samples = 0;
  refused(view, o);
  o.edge_samples = 17;
  refused(view, o);
  o = options(8, 8);
  o.near_plane = 3;
  o.far_plane = 2;
  refused(view, o);
  o.far_plane = std::nan("");
  refused(view, o);
}

TEST(Raster, NearAndFarPlanesClip) {
  Mesh mesh = triangle(Vector(-50, -50, -2), Vector(50, -50, -2), Vector(0, 90, -2));
  test_scenes::add_triangle(mesh, Vector(-50, -50, -4), Vector(50, -50, -4), Vector(0, 90, -4));
  test_scenes::add_triangle(mesh, Vector(-50, -50, -8), Vector(50, -50, -8), Vector(0, 90, -8));
  const Scene scene(mesh);
  const View view = plane_view(Vector(0), Vector(0, 0, -1), 1);
  RasterOptions o = options(8, 8);
  EXPECT_EQ(render_raster(scene, view, {}, o).ids[0], 0);
  o.near_plane = 3;
  EXPECT_EQ(render_raster(scene, view, {}, o).ids[0], 1);
  o.near_plane = 5;
  EXPECT_EQ(render_raster(scene, view, {}, o).ids[0], 2);
  o.far_plane = 7;
  EXPECT_EQ(render_raster(scene, view, {}, o).ids[0], kNoFace);
}

}  // namespace
