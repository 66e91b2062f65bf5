// Inputs that once got a wrong answer, each under the name of what broke.

#include <facemap/camera.h>
#include <facemap/error.h>
#include <facemap/point_light.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/oracle.h"
#include "support/scenes.h"

namespace {

using namespace facemap;

Camera panorama(const Scene& scene, const Vector& position, const DVector& sight, int width, int height) {
  Camera::Options options;
  options.field_angle = 2 * M_PI;
  options.width = width;
  options.height = height;
  return Camera(scene, SpaceVector::looking_along(position, sight), options);
}

// The antipode's map point is on the rim, which touches the raster's border: directions there had no texel, so a
// camera saw nothing and a light called everything lit.
TEST(PastFailure, DirectionsAtTheAntipodeHaveATexel) {
  const Scene scene(test_scenes::box({-1, -1, -1}, {1, 1, 1}));
  const Vector inside(0.25f, 0.125f, -0.5f);
  for (const Vector& sight :
       {Vector(3, 1, -2), Vector(1, 0, -1), Vector(0, 0, -1), Vector(0, -1, 0), Vector(1, 0, 0)}) {
    for (const int width : {1, 4, 37}) {
      const Camera camera = panorama(scene, inside, DVector(sight), width, 4);
      for (const float length : {1.0f, 3.0f, 0x1p-20f}) EXPECT_TRUE(camera.nearest(-length * sight)) << width;
    }
  }
  // A light at the scene's centre looks along -z.
  const PointLight light(scene, {0, 0, 0});
  EXPECT_FALSE(light.get_lighten_up(Vector(0, 0, 1.5f)));
  EXPECT_FALSE(light.get_lighten_up(Vector(0x1p-60f, 0, 1.5f)));
  EXPECT_TRUE(light.get_lighten_up(Vector(0, 0, 0.5f)));
}

// The camera is 5e-17 off a face's plane: n . d rounds to zero in double, and the quotient was infinite.
TEST(PastFailure, DepthIsTheExactQuotientWhereTheSlopeRoundsToZero) {
  constexpr float r = 0.565256834f, e = 3.46119996e-17f;
  Mesh mesh;
  mesh.positions = {{0, r, 0}, {0, e, r}, {r, e, e}, {2 * e, e, -r}, {-r, e, -3 * e}, {0, -r, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}, {5, 2, 1}, {5, 3, 2}, {5, 4, 3}, {5, 1, 4}};
  const Scene scene(mesh);
  const Vector position(-0x1.216958p-2f, -0x1.216958p-2f, -0x1.dedbeap-55f);
  const Camera camera = panorama(scene, position, DVector(1, 2, 3), 39, 1);
  const oracle::Oracle oracle(scene.mesh());
  const oracle::View view = oracle.from(position);
  for (const Vector& d : {Vector(0x1.ad86f8p-5f, 0x1.ad86f8p-5f, 0x1.ad86f8p-4f),
                          Vector(0x1.b21e04p+0f, 0x1.216958p-1f, 0x1.216958p+1f)}) {
    const Camera::Hit hit = camera.nearest(d);
    ASSERT_EQ(hit.face, 7);
    EXPECT_FLOAT_EQ(hit.depth, static_cast<float>(view.distance(7, d)));
  }
}

// Texels that span radians: the rounding of a map point, half a unit of a coordinate of thousands, is then a wider
// angle than any other error. The vertex was put left of a column's border, a ray to it right of it.
TEST(PastFailure, ARayToAVertexFindsItsTexelOnRastersOfWideTexels) {
  struct Case {
    ProjectionKind projection;
    double field_angle, sine, cosine;  // of the turn about y
    int width, height;
    Vector a, b, c;
  };
  const Case cases[] = {
      {ProjectionKind::Surface, 0x1.921fb54442d18p+2, -0x1.d662eed3f2defp-13, 0x1.ffffff27ec25p-1, 32768, 1,
       Vector(-0x1.6c259p-12f, 0x1.f19138p-8f, -0x1.8c5c9p+0f), Vector(-0x1.6d32p-12f, 0x1.f1964p-8f, -0x1.8c5c9p+0f),
       Vector(-0x1.6d32p-12f, 0x1.f188d4p-8f, -0x1.8c5c96p+0f)},
      {ProjectionKind::Plane, 3.14159265, -0x1.73e8e55e5340fp-18, 0x1.ffffffffde3b3p-1, 1024, 1024,
       Vector(-0x1.21a52p-17f, -0x1.7bf01p-11f, -0x1.8c88f8p+0f),
       Vector(-0x1.43331p-17f, -0x1.7bc7ccp-11f, -0x1.8c88f8p+0f),
       Vector(-0x1.43331p-17f, -0x1.7c332cp-11f, -0x1.8c88fep+0f)}};
  for (const Case& test : cases) {
    Mesh mesh;
    test_scenes::add_triangle(mesh, test.a, test.b, test.c);
    const Scene scene(mesh);
    const SpaceVector frame(Vector(0), {test.cosine, 0, test.sine}, {0, 1, 0}, {test.sine, 0, -test.cosine});
    Camera::Options options;
    options.projection = test.projection;
    options.field_angle = test.field_angle;
    options.width = test.width;
    options.height = test.height;
    const Camera camera(scene, frame, options);
    for (const float length : {1.0f, 3.0f}) EXPECT_TRUE(camera.nearest(length * test.a)) << test.width;
  }
}

// Faces nearer than 2^-126 of the scene: their bounds of distance are denormal floats, and were rounded up.
TEST(PastFailure, DistanceBoundsAreRoundedDownAmongDenormals) {
  constexpr float u = 0x1p-49f;  // times the map's scale, 2^-100: the least float
  Mesh mesh;
  test_scenes::add_triangle(mesh, {0x1p100f, 0, 0}, {0, 0x1p100f, 0}, {0, 0, 0x1p99f});
  for (int i = 0; i < 40; ++i) {  // more than a camera looks at in one go
    const float z = -(1.6f + 0.001f * static_cast<float>(i)) * u;
    test_scenes::add_triangle(mesh, {-4 * u, -4 * u, z}, {4 * u, -4 * u, z}, {0, 6 * u, z});
  }
  test_scenes::add_triangle(mesh, {-u, -u, -1.55f * u}, {u, -u, -1.55f * u}, {0, 2 * u, -1.55f * u});
  const Scene scene(mesh);
  EXPECT_EQ(panorama(scene, {0, 0, 0}, DVector(0, 0, -1), 1, 1).nearest({0, 0, -1}).face, 41);
}

// A NaN was read past the end of a table of arc tangents.
TEST(PastFailure, DirectionsThatAreNotFiniteHitNothing) {
  const Scene scene(test_scenes::box({-1, -1, -1}, {1, 1, 1}));
  const float nan = std::numeric_limits<float>::quiet_NaN(), infinity = std::numeric_limits<float>::infinity();
  Camera::Options options;
  options.width = options.height = 16;
  options.keep_all = true;
  for (const ProjectionKind projection : {ProjectionKind::Surface, ProjectionKind::Plane}) {
    options.projection = projection;
    const Camera camera(scene, SpaceVector::looking_along({0, 0, 0}, DVector(1, 2, 3)), options);
    for (const Vector& d : {Vector(0), Vector(nan, 0, 1), Vector(1, 2, nan), Vector(infinity, 0, 0),
                            Vector(infinity, 1, -infinity), Vector(infinity, infinity, infinity)}) {
      EXPECT_FALSE(camera.texel_of(DVector(d)));
      EXPECT_EQ(camera.count_hits(d), 0);
      EXPECT_FALSE(camera.nearest(d));
    }
  }
}

// A ray along its face's plane has no point there: the division by zero ended the program.
TEST(PastFailure, APointThatARayDoesNotMeetIsRefused) {
  const Scene scene(test_scenes::box({-1, -1, -1}, {1, 1, 1}));
  const PointLight light(scene, {0, 5, 0});
  SurfacePoint point;
  point.origin = {3, 4, 5};
  point.vertices = {Vector(0, 0, 0), Vector(1, 0, 0), Vector(1, 0, 1)};
  point.side = 1;
  point.direction = {1, 0, 0};
  EXPECT_THROW(light.is_blocked(point), Error);
  point.direction = {std::numeric_limits<float>::quiet_NaN(), -1, 0};
  EXPECT_THROW(light.is_blocked(point), Error);
  point.direction = {-3, -4, -5};
  point.face = 99;
  EXPECT_THROW(light.get_lighten_up(point), Error);
  PointLight::On on;
  on.tolerance = std::numeric_limits<float>::infinity();
  EXPECT_THROW(light.get_lighten_up(Vector(0, -5, 0), on), Error);
}

}  // namespace
