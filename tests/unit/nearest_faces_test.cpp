#include "picture/nearest_faces.h"

#include <facemap/camera.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "simd/nearest_vertices.h"
#include "simd/target.h"
#include "support/lenses.h"
#include "support/scenes.h"

namespace {

using facemap::Camera;
using facemap::DVector;
using facemap::Executor;
using facemap::Lens;
using facemap::Mesh;
using facemap::NearestFaces;
using facemap::Projection;
using facemap::ProjectionKind;
using facemap::SampleGrid;
using facemap::Scene;
using facemap::SpaceVector;
using facemap::Vector;

constexpr double kDegree = 0.017453292519943295;

Camera::Options options_of(const Lens& lens) {
  Camera::Options options;
  options.width = lens.width();
  options.height = lens.height();
  options.field_angle = 360 * kDegree;
  if (const Projection* projection = lens.projection()) {
    options.projection = projection->kind();
    options.field_angle = projection->field_angle();
  }
  return options;
}

// What Camera::nearest says of every sample.
NearestFaces asked_one_by_one(const Scene& scene, const SampleGrid& grid) {
  const Camera camera(scene, grid.frame, options_of(grid.lens));
  NearestFaces nearest;
  for (int row = 0; row < grid.rows(); ++row) {
    for (int column = 0; column < grid.columns(); ++column) {
      const Camera::Hit hit = camera.nearest(grid.direction(column, row));
      if (hit && (hit.tied || !hit.strictly_inside)) {
        nearest.loose.push_back(static_cast<std::uint32_t>(nearest.faces.size()));
      }
      nearest.faces.push_back(hit.face);
    }
  }
  return nearest;
}

class Targets {
 public:
  Targets() : before_(facemap::simd::active_target()) {}
  ~Targets() { facemap::simd::set_active_target(before_); }
  std::vector<facemap::simd::Target> all = facemap::simd::supported_targets();

 private:
  facemap::simd::Target before_;
};

std::string first_difference(const NearestFaces& is, const NearestFaces& should, int columns) {
  for (std::size_t i = 0; i < should.faces.size(); ++i) {
    if (is.faces[i] == should.faces[i]) continue;
    return "sample " + std::to_string(i % columns) + ", " + std::to_string(i / columns) + ": face " +
           std::to_string(is.faces[i]) + " instead of " + std::to_string(should.faces[i]);
  }
  return "";
}

void expect_as_asked(const Mesh& mesh, const SampleGrid& grid, const std::string& what) {
  const Scene scene(mesh);
  const NearestFaces should = asked_one_by_one(scene, grid);
  Targets targets;
  std::optional<facemap::Counters> counted;
  for (const auto target : targets.all) {
    facemap::simd::set_active_target(target);
    for (const int threads : {1, 2, 3}) {
      facemap::Counters counters;
      const NearestFaces is = find_nearest_faces(scene, grid, Executor(threads), &counters);
      const std::string where = what + ", " + facemap::simd::name_of(target) + ", threads " + std::to_string(threads);
      ASSERT_EQ(first_difference(is, should, grid.columns()), "") << where;
      ASSERT_EQ(is.faces.size(), should.faces.size()) << where;
      ASSERT_EQ(is.loose, should.loose) << where;
      if (!counted) counted = counters;
      ASSERT_EQ(counters.by_float, counted->by_float) << where;
      ASSERT_EQ(counters.by_double, counted->by_double) << where;
      ASSERT_EQ(counters.by_exact, counted->by_exact) << where;
    }
  }
}

SpaceVector looking(const Vector& from, const Vector& at) {
  if (from == at) return SpaceVector::looking_along(from, DVector(0.3, -0.2, -1));
  return SpaceVector::looking_along(from, DVector(at) - DVector(from));
}

SampleGrid plane_grid(const SpaceVector& frame, double degrees, int width, int height, int per_side = 1) {
  return {frame, Projection(ProjectionKind::Plane, degrees * kDegree, width, height), per_side};
}

TEST(NearestFaces, OfRandomScenesAreThoseOfTheCamera) {
  Random random(20260001);
  for (int i = 0; i < 250; ++i) {
    const test_scenes::TestScene scene = test_scenes::make_any_scene(random, 120);
    const Vector from = test_scenes::make_origin(scene, random);
    const Vector at = random.chance(0.8) ? scene.centre : test_scenes::make_origin(scene, random);
    const int width = random.between(1, 70), height = random.between(1, 70);
    const double fields[] = {0.01, 10, 50, 50, 90, 130, 170, 179};
    const double degrees = fields[random.below(8)];
    const SampleGrid grid = plane_grid(looking(from, at), degrees, width, height, random.chance(0.2) ? 2 : 1);
    expect_as_asked(scene.mesh, grid,
                    "scene " + std::to_string(i) + " (" + scene.name + "), " + std::to_string(degrees) + " degrees, " +
                        std::to_string(width) + " x " + std::to_string(height));
    if (HasFatalFailure()) return;
  }
}

// Some of the picture, or all of it.
void crop(Random& random, SampleGrid& grid) {
  const int columns = grid.columns_of_picture(), rows = grid.rows_of_picture();
  grid.first_column = random.below(columns);
  grid.first_row = random.below(rows);
  grid.column_count = random.between(1, columns - grid.first_column);
  grid.row_count = random.between(1, rows - grid.first_row);
}

TEST(NearestFaces, OfOtherLensesAreThoseOfTheCamera) {
  Random random(20260003);
  for (int i = 0; i < 250; ++i) {
    const test_scenes::TestScene scene = test_scenes::make_any_scene(random, 120);
    const Vector from = test_scenes::make_origin(scene, random);
    const Vector at = random.chance(0.8) ? scene.centre : test_scenes::make_origin(scene, random);
    const NamedLens named = random_lens(random, 80);
    SampleGrid grid{looking(from, at), named.lens, random.chance(0.2) ? 2 : 1};
    if (random.chance(0.3)) crop(random, grid);
    expect_as_asked(scene.mesh, grid,
                    "scene " + std::to_string(i) + " (" + scene.name + "), " + named.name + " " +
                        std::to_string(named.lens.width()) + " x " + std::to_string(named.lens.height()));
    if (HasFatalFailure()) return;
  }
}

TEST(NearestFaces, OfPartsAreThoseOfTheWhole) {
  Random random(20260004);
  for (int i = 0; i < 60; ++i) {
    const test_scenes::TestScene made = test_scenes::make_any_scene(random, 120);
    const Scene scene(made.mesh);
    const SpaceVector frame = looking(test_scenes::make_origin(made, random), made.centre);
    const Projection projection(random.chance(0.5) ? ProjectionKind::Plane : ProjectionKind::Surface, 1.5, 90, 70);
    const Lens lens = random.chance(0.6) ? Lens(projection) : random_lens(random, 80).lens;
    SampleGrid part{frame, lens, random.between(1, 2)};
    const SampleGrid whole = part;
    crop(random, part);
    const Executor executor(2);
    const NearestFaces all = find_nearest_faces(scene, whole, executor);
    const NearestFaces some = find_nearest_faces(scene, part, executor);
    for (int row = 0; row < part.rows(); ++row) {
      for (int column = 0; column < part.columns(); ++column) {
        const int of_whole = (part.first_row + row) * whole.columns() + part.first_column + column;
        ASSERT_EQ(some.faces[static_cast<std::size_t>(row * part.columns() + column)],
                  all.faces[static_cast<std::size_t>(of_whole)])
            << "round " << i << ", column " << column << ", row " << row;
        ASSERT_EQ(part.direction(column, row), whole.direction(part.first_column + column, part.first_row + row));
      }
    }
  }
}

SampleGrid surface_grid(const SpaceVector& frame, double degrees, int width, int height, int per_side = 1) {
  return {frame, Projection(ProjectionKind::Surface, degrees * kDegree, width, height), per_side};
}

TEST(NearestFaces, OfFisheyesAreThoseOfTheCamera) {
  Random random(20260002);
  for (int i = 0; i < 250; ++i) {
    const test_scenes::TestScene scene = test_scenes::make_any_scene(random, 120);
    const Vector from = test_scenes::make_origin(scene, random);
    const Vector at = random.chance(0.8) ? scene.centre : test_scenes::make_origin(scene, random);
    const int width = random.between(1, 70), height = random.between(1, 70);
    const double fields[] = {0.01, 10, 50, 50, 90, 180, 360, 360};
    const double degrees = fields[random.below(8)];
    const SampleGrid grid = surface_grid(looking(from, at), degrees, width, height, random.chance(0.2) ? 2 : 1);
    expect_as_asked(scene.mesh, grid,
                    "scene " + std::to_string(i) + " (" + scene.name + "), " + std::to_string(degrees) + " degrees, " +
                        std::to_string(width) + " x " + std::to_string(height));
    if (HasFatalFailure()) return;
  }
}

// A face whose corners lie on samples' centres, up to rounding, and its neighbours: the view is along an axis.
TEST(NearestFaces, WithVerticesOnSamplesAreThoseOfTheCamera) {
  Random random(20260003);
  for (const int size : {1, 2, 7, 16, 33}) {
    Mesh mesh;
    for (int i = 0; i < 60; ++i) {
      // Half samples at distance 2 of a view of 90 degrees.
      const auto corner = [&] {
        const double x = random.between(-2 * size, 2 * size) * 0.5 + 0.5 * (size % 2 == 0);
        const double y = random.between(-2 * size, 2 * size) * 0.5 + 0.5 * (size % 2 == 0);
        const double depth = random.chance(0.5) ? 2 : 1 + random.between(0, 2);
        return Vector(x * 2 / size * depth, y * 2 / size * depth, -depth);
      };
      const Vector a = corner(), b = corner(), c = corner();
      test_scenes::add_triangle(mesh, a, b, c);
    }
    const SpaceVector frame = SpaceVector::looking_along(Vector(0), DVector(0, 0, -1));
    expect_as_asked(mesh, plane_grid(frame, 90, size, size), "plane " + std::to_string(size));
    expect_as_asked(mesh, surface_grid(frame, 90, size, size), "surface " + std::to_string(size));
    if (HasFatalFailure()) return;
  }
}

// More than one contest a sample, in the plane of others and in one that is almost the same.
TEST(NearestFaces, OfSheetsUponEachOtherAreThoseOfTheCamera) {
  Mesh mesh;
  for (int i = 0; i < 4; ++i) {
    const auto shift = static_cast<float>(i) * 0.125f, lift = i == 3 ? 0x1p-24f : 0.0f;
    test_scenes::add_triangle(mesh, Vector(-3 + shift, 0.5f, -3), Vector(3 + shift, 0.5f, -3.5f),
                              Vector(shift, 0.5f + lift, 4));
  }
  test_scenes::add_triangle(mesh, Vector(0, 0.5f, 5), Vector(3, 0.5f, -2),
                            Vector(-3, 0.5f, -2));  // turned the other way
  const SpaceVector frame = SpaceVector::looking_at(Vector(0.25f, 1.5f, 0.5f), Vector(0), Vector(0, 0, 1));
  expect_as_asked(mesh, plane_grid(frame, 80, 67, 45), "plane");
  expect_as_asked(mesh, surface_grid(frame, 80, 67, 45), "surface");
}

TEST(NearestFaces, FromInsideABoxAreItsWalls) {
  Random random(20260004);
  const Mesh mesh = test_scenes::box(Vector(-1, -2, -3), Vector(3, 2, 1));
  const Scene scene(mesh);
  for (int i = 0; i < 20; ++i) {
    const DVector at = random.in_cube();
    const SpaceVector frame = SpaceVector::looking_along(Vector(at * 0.9), random.direction());
    const double degrees = random.between(1.0, 179.0);
    expect_as_asked(mesh, plane_grid(frame, degrees, 31, 40), "plane " + std::to_string(degrees));
    expect_as_asked(mesh, surface_grid(frame, 2 * degrees, 40, 31), "surface " + std::to_string(2 * degrees));
    if (HasFatalFailure()) return;
    const NearestFaces nearest = find_nearest_faces(scene, surface_grid(frame, 360, 24, 24), Executor(1));
    for (int row = 0; row < 24; ++row) {
      for (int column = 0; column < 24; ++column) {
        const SampleGrid grid = surface_grid(frame, 360, 24, 24);
        const bool has_direction = grid.direction(column, row) != Vector(0);
        ASSERT_EQ(nearest.faces[static_cast<std::size_t>(row * 24 + column)] != facemap::kNoFace, has_direction);
      }
    }
  }
}

// Pictures over many blocks, tiles and bands, with faces of all sizes.
TEST(NearestFaces, OfLargePicturesAreThoseOfTheCamera) {
  Random random(20260005);
  const test_scenes::TestScene scene = test_scenes::make_scene(test_scenes::Kind::Soup, 4000, random);
  const SpaceVector frame = looking(Vector(0.1f, 0.3f, 2.5f), Vector(0));
  expect_as_asked(scene.mesh, plane_grid(frame, 60, 301, 203), "plane");
  expect_as_asked(scene.mesh, surface_grid(frame, 200, 203, 301), "surface");
  expect_as_asked(scene.mesh, plane_grid(looking(Vector(0), Vector(1, 0, 0)), 100, 120, 90, 3), "plane, inside");
}

// Threads project neighbouring ranges of vertices at the same time.
TEST(NearestFaces, VerticesAfterARangeAreLeftAlone) {
  constexpr std::size_t kMost = 40, kRoom = 2 * (kMost + facemap::simd::kVertexRoom);
  constexpr float kUntouched = 12345;
  const std::vector<float> positions(3 * kMost, 1);
  const facemap::simd::VertexFrame frame = {.origin = {},
                                            .rows = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
                                            .unit = 1,
                                            .limit = 2,
                                            .edge_u = 2,
                                            .edge_v = 2,
                                            .slack_u = 0,
                                            .slack_v = 0,
                                            .slack_z = 0};
  const facemap::simd::SurfaceFrame surface = {.frame = frame, .per_radian = 1, .largest_angle = 3};
  const Targets targets;
  for (const facemap::simd::Target target : targets.all) {
    facemap::simd::set_active_target(target);
    for (std::size_t count = 0; count <= kMost; ++count) {
      std::vector<float> plane_points(kRoom, kUntouched), surface_points(kRoom, kUntouched);
      facemap::simd::project_vertices(positions.data(), count, frame, plane_points.data());
      facemap::simd::project_vertices_surface(positions.data(), count, surface, surface_points.data());
      for (std::size_t i = 0; i < kRoom; ++i) {
        ASSERT_EQ(plane_points[i] == kUntouched, i >= 2 * count) << facemap::simd::name_of(target) << " " << count;
        ASSERT_EQ(surface_points[i] == kUntouched, i >= 2 * count) << facemap::simd::name_of(target) << " " << count;
      }
    }
  }
}

}  // namespace
