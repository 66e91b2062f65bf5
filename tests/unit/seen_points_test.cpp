#include "picture/seen_points.h"

#include <facemap/camera.h>
#include <gmpxx.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "map/face_planes.h"
#include "picture/ray_table.h"
#include "simd/target.h"
#include "support/oracle.h"
#include "support/queries.h"
#include "support/scenes.h"

using namespace facemap;
using namespace test_scenes;

namespace {

struct Picture {
  SampleGrid grid;
  NearestFaces nearest;
};

Picture take_picture(const Scene& scene, const SpaceVector& frame, const Projection& projection, int per_side) {
  Picture picture{{frame, projection, per_side}, {}};
  Camera::Options options;
  options.projection = projection.kind();
  options.field_angle = projection.field_angle();
  options.width = projection.width();
  options.height = projection.height();
  const Camera camera(scene, frame, options);
  std::uint32_t sample = 0;
  for (int row = 0; row < picture.grid.rows(); ++row) {
    for (int column = 0; column < picture.grid.columns(); ++column, ++sample) {
      const Camera::Hit hit = camera.nearest(picture.grid.direction(column, row));
      picture.nearest.faces.push_back(hit.face);
      if (hit && (hit.tied || !hit.strictly_inside)) picture.nearest.loose.push_back(sample);
    }
  }
  return picture;
}

struct Rational {
  mpq_class x, y, z;
};

Rational rational(const DVector& v) { return {mpq_class(v.x), mpq_class(v.y), mpq_class(v.z)}; }
Rational rational(const Vector& v) { return rational(DVector(v)); }
Rational operator-(const Rational& a, const Rational& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
mpq_class dot(const Rational& a, const Rational& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Rational cross(const Rational& a, const Rational& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

// Where the sample's ray meets the plane of its face.
Rational true_point(const Scene& scene, const SampleGrid& grid, std::uint32_t sample, std::uint32_t face) {
  const auto columns = static_cast<std::uint32_t>(grid.columns());
  const Triangle f = triangle_of(scene, face);
  const Rational K = rational(grid.frame.position());
  const Rational d = rational(grid.direction(static_cast<int>(sample % columns), static_cast<int>(sample / columns)));
  const Rational a = rational(f[0]), n = cross(rational(f[1]) - a, rational(f[2]) - a);
  const mpq_class t = dot(n, a - K) / dot(n, d);
  return {K.x + t * d.x, K.y + t * d.y, K.z + t * d.z};
}

void expect_points_within_error(const Scene& scene, const Picture& picture, const SeenPoints& seen) {
  const AskedPoints& points = seen.points;
  const Rational origin = rational(points.origin);
  const mpq_class step(points.step), allowed = mpq_class(points.error) * mpq_class(points.error);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Rational stored{origin.x + step * points.x[i], origin.y + step * points.y[i], origin.z + step * points.z[i]};
    const Rational off = stored - true_point(scene, picture.grid, points.samples[i], points.faces[i]);
    ASSERT_LE(dot(off, off), allowed) << "sample " << points.samples[i];
  }
}

void expect_each_hit_once(const Picture& picture, const SeenPoints& seen) {
  std::vector<int> times(picture.nearest.faces.size());
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    ++times[seen.points.samples[i]];
    EXPECT_EQ(static_cast<FaceId>(seen.points.faces[i]), picture.nearest.faces[seen.points.samples[i]]);
  }
  for (std::size_t i = 0; i < times.size(); ++i) EXPECT_EQ(times[i], picture.nearest.faces[i] != kNoFace);
}

void expect_loose_points(const Picture& picture, const SeenPoints& seen) {
  EXPECT_TRUE(std::is_sorted(seen.loose.begin(), seen.loose.end()));
  std::vector<std::uint32_t> samples;
  for (const std::uint32_t point : seen.loose) samples.push_back(seen.points.samples[point]);
  std::sort(samples.begin(), samples.end());
  EXPECT_EQ(samples, picture.nearest.loose);
}

void expect_exact_facing(const Mesh& mesh, const Vector& camera, const std::vector<Vector>& lights,
                         const SeenPoints& seen) {
  const oracle::Oracle oracle(mesh);
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    const auto face = static_cast<FaceId>(seen.points.faces[i]);
    for (std::size_t l = 0; l < seen.stride * 8; ++l) {
      const bool expected = l < lights.size() && oracle.side(face, camera) * oracle.side(face, lights[l]) > 0;
      const bool found = (seen.masks[i * seen.stride + l / 8] >> (l % 8) & 1) != 0;
      ASSERT_EQ(found, expected) << "face " << face << ", light " << l;
    }
  }
}

void expect_equal(const SeenPoints& a, const SeenPoints& b) {
  EXPECT_EQ(a.points.origin, b.points.origin);
  EXPECT_EQ(a.points.step, b.points.step);
  EXPECT_EQ(a.points.error, b.points.error);
  EXPECT_EQ(a.points.x, b.points.x);
  EXPECT_EQ(a.points.y, b.points.y);
  EXPECT_EQ(a.points.z, b.points.z);
  EXPECT_EQ(a.points.faces, b.points.faces);
  EXPECT_EQ(a.points.samples, b.points.samples);
  EXPECT_EQ(a.masks, b.masks);
  EXPECT_EQ(a.stride, b.stride);
  EXPECT_EQ(a.loose, b.loose);
}

void expect_same_for_all_targets_and_threads(const Scene& scene, const Picture& picture,
                                             const std::vector<Vector>& lights, const SeenPoints& expected) {
  const simd::Target before = simd::active_target();
  int threads = 1;
  for (const simd::Target target : simd::supported_targets()) {
    SCOPED_TRACE(std::string(simd::name_of(target)) + ", " + std::to_string(threads) + " threads");
    simd::set_active_target(target);
    expect_equal(find_seen_points(scene, picture.grid, picture.nearest, lights, Executor(threads)), expected);
    threads = threads % 3 + 1;
  }
  simd::set_active_target(before);
}

void expect_all(const Scene& scene, const Picture& picture, const std::vector<Vector>& lights) {
  const SeenPoints seen = find_seen_points(scene, picture.grid, picture.nearest, lights, Executor(1));
  ASSERT_EQ(seen.stride, (lights.size() + 7) / 8);
  expect_each_hit_once(picture, seen);
  expect_loose_points(picture, seen);
  expect_points_within_error(scene, picture, seen);
  expect_exact_facing(scene.mesh(), picture.grid.frame.position(), lights, seen);
  expect_same_for_all_targets_and_threads(scene, picture, lights, seen);
}

SpaceVector look_at_centre(const TestScene& scene, const Vector& camera) {
  const DVector sight = DVector(scene.centre) - DVector(camera);
  return SpaceVector::looking_along(camera, sight == DVector(0) ? DVector(0, 0, -1) : sight);
}

Projection random_projection(Random& random) {
  const int width = random.between(1, 45), height = random.between(1, 45);
  if (random.chance(0.5)) return {ProjectionKind::Plane, random.between(0.2, 2.5), width, height};
  return {ProjectionKind::Surface, random.between(0.2, 6.28), width, height};
}

// A rounding to float and back that a compiler must not drop (g++ 12 does, see CMakeLists.txt).
[[gnu::noinline]] void round_to_float(const double* from, double* to) {
  to[0] = static_cast<double>(static_cast<float>(from[0]));
  to[1] = static_cast<double>(static_cast<float>(from[1]));
}

TEST(SeenPoints, CompilerKeepsRoundingsToFloat) {
  const double third[2] = {1.0 / 3, 1.0 / 3};
  double rounded[2];
  round_to_float(third, rounded);
  EXPECT_EQ(rounded[0], 0x1.555556p-2);
  EXPECT_EQ(rounded[1], 0x1.555556p-2);
}

TEST(SeenPoints, DirectionsAreThoseOfTheGrid) {
  const simd::Target before = simd::active_target();
  Random random(3);
  for (int repeat = 0; repeat < 40; ++repeat) {
    const SpaceVector frame = SpaceVector::looking_along(Vector(1, 2, 3), random.direction());
    const SampleGrid grid{frame, random_projection(random), random.between(1, 3)};
    const RayTable rays(grid);
    const auto columns = static_cast<std::size_t>(grid.columns());
    for (const simd::Target target : simd::supported_targets()) {
      simd::set_active_target(target);
      for (int row = 0; row < grid.rows(); ++row) {
        const std::vector<double> y(simd::kSeenBatch, rays.rows[static_cast<std::size_t>(row)]);
        std::vector<double> x(simd::kSeenBatch);
        std::copy(rays.columns.begin(), rays.columns.end(), x.begin());
        float direction[3][simd::kSeenBatch];
        simd::ray_directions(rays.frame, x.data(), y.data(), columns, direction[0], direction[1], direction[2]);
        for (int column = 0; column < grid.columns(); ++column) {
          const Vector expected = grid.direction(column, row);
          if (expected == Vector(0)) continue;  // no face is seen there
          ASSERT_EQ(Vector(direction[0][column], direction[1][column], direction[2][column]), expected)
              << simd::name_of(target);
        }
      }
    }
  }
  simd::set_active_target(before);
}

TEST(SeenPoints, AreExactInAwkwardScenes) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const TestScene made = make_any_scene(random, 60);
    const Scene scene{made.mesh};
    const Vector camera = make_origin(made, random);
    std::vector<Vector> lights(static_cast<std::size_t>(random.between(0, 12)));
    for (Vector& light : lights) light = make_origin(made, random);
    const Picture picture =
        take_picture(scene, look_at_centre(made, camera), random_projection(random), random.between(1, 2));
    expect_all(scene, picture, lights);
    if (HasFailure()) FAIL() << test_queries::write_failure(made.mesh, "seed " + std::to_string(seed));
  }
}

// Above 65536 samples the points' box is guessed from few of them: which may or may not see what covers few pixels a
// thousand radii behind a ball.
TEST(SeenPoints, OfALargePictureHaveAsMuchRoomAsTheyNeed) {
  Random random(7);
  const TestScene ball = make_scene(Kind::Ball, 100, random);
  const SpaceVector frame = SpaceVector::looking_at(ball.centre + Vector(0, 0, static_cast<float>(4 * ball.radius)),
                                                    ball.centre, Vector(0, 1, 0));
  const Projection projection(ProjectionKind::Plane, 0.9, 270, 250);
  const float far = static_cast<float>(1000 * ball.radius), small = far * 0.009f;
  for (const float place : {0.2f, 0.3f, 0.4f, 0.45f}) {
    SCOPED_TRACE(place);
    Mesh mesh = ball.mesh;
    const Vector corner = ball.centre + Vector(far * place, far * 0.42f, -far);
    add_triangle(mesh, corner, corner + Vector(small, 0, 0), corner + Vector(0, small, 0));
    const Scene scene{mesh};
    const Picture picture = take_picture(scene, frame, projection, 1);
    const auto far_face = static_cast<FaceId>(mesh.face_count() - 1);
    const auto count = std::count(picture.nearest.faces.begin(), picture.nearest.faces.end(), far_face);
    EXPECT_GE(count, 1);
    EXPECT_LE(count, 8);
    const std::vector<Vector> lights = {make_origin(ball, random), Vector(1, 2, 3)};
    const SeenPoints seen = find_seen_points(scene, picture.grid, picture.nearest, lights, Executor(2));
    expect_each_hit_once(picture, seen);
    expect_points_within_error(scene, picture, seen);
  }
}

// From as near to a face's plane as float32 allows, beside the face: doubles alone do not know where rays meet it.
TEST(SeenPoints, AreSharpWhereRaysGraze) {
  std::size_t count = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const DVector a = random.in_cube(), b = random.in_cube(), c = random.in_cube();
    Mesh mesh;
    add_triangle(mesh, Vector(a), Vector(b), Vector(c));
    const Vector camera((a + b) * 0.5 * 3.0 - c * 2.0);
    const SpaceVector frame = SpaceVector::looking_along(camera, c - DVector(camera));
    const Scene scene{mesh};
    const double field = std::ldexp(1.0, -random.between(18, 23));
    const Picture picture = take_picture(scene, frame, Projection(ProjectionKind::Plane, field, 40, 40), 1);
    count += static_cast<std::size_t>(1600 -
                                      std::count(picture.nearest.faces.begin(), picture.nearest.faces.end(), kNoFace));
    expect_all(scene, picture, {Vector(random.in_cube()), camera, Vector(c), Vector((a + b) * 0.5)});
  }
  EXPECT_GT(count, 1000u);
}

TEST(SeenPoints, OfAnEmptyPictureAreNone) {
  Mesh mesh;
  add_triangle(mesh, Vector(0, 0, 5), Vector(1, 0, 5), Vector(0, 1, 5));
  const Scene scene{mesh};
  const Picture picture = take_picture(scene, SpaceVector::looking_along(Vector(0), DVector(0, 0, -1)),
                                       Projection(ProjectionKind::Plane, 1, 20, 20), 1);
  EXPECT_EQ(find_seen_points(scene, picture.grid, picture.nearest, {Vector(1)}, Executor(2)).points.size(), 0u);
}

}  // namespace
