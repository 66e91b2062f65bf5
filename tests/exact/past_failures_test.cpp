// Inputs that once got a wrong answer, each under the name of what broke.

#include <facemap/camera.h>
#include <facemap/point_light.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <cmath>

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

}  // namespace
