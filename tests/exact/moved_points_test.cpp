// Points lifted off their faces (the shadow terminator fix) in the transposed way: entry faces of closed parts may be
// left out for those that the camera sees, and pictures are those of the lists, which ask all faces.

#include "picture/moved_points.h"

#include <facemap/renderer.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>
#include <vector>

#include "map/face_planes.h"
#include "math/dvector.h"
#include "math/exact_sign.h"
#include "picture/hidden_points.h"
#include "scene/closed_parts.h"
#include "support/queries.h"
#include "support/scenes.h"

namespace {

using namespace facemap;

// Solids that may be nested, overlap, be inside out or cut themselves; with small integer corners, which then touch.
Mesh random_solids(Random& random) {
  const bool on_lattice = random.chance(0.5);
  Mesh mesh;
  for (int i = random.between(1, 4); i > 0; --i) {
    const DVector a = random.in_cube(), b = random.in_cube();
    Mesh solid = random.chance(0.5)
                     ? test_scenes::uv_sphere(random.between(3, 9), random.between(2, 6), a, random.between(0.2, 1.5))
                     : test_scenes::box(Vector(-2.0 + a), Vector(0.5 + b));
    if (random.chance(0.2)) {
      for (Corners& t : solid.triangles) std::swap(t[1], t[2]);
    }
    if (random.chance(0.2)) {
      for (Vector& v : solid.positions) v = Vector(2.0 * random.in_cube());
    }
    for (Vector& v : solid.positions) {
      for (int axis = 0; axis < 3 && on_lattice; ++axis) v[axis] = std::nearbyint(2 * v[axis]);
    }
    mesh = test_scenes::joined(mesh, solid);
  }
  return mesh;
}

Vector random_place(const Mesh& mesh, Random& random, double reach) {
  const std::size_t face = static_cast<std::size_t>(random.below(static_cast<int>(mesh.face_count())));
  const DVector a(mesh.vertex(face, 0)), b(mesh.vertex(face, 1)), c(mesh.vertex(face, 2));
  if (random.chance(0.1)) return Vector(a);
  if (random.chance(0.1)) return Vector((a + b) * 0.5);
  if (random.chance(0.2)) return Vector((a + b + c + c) * 0.25);
  if (random.chance(0.3)) return Vector((a + b + c) * (1.0 / 3) + random.in_cube() * 0.05);
  return Vector(reach * random.in_cube());
}

AskedPoints placed(const MovedPoints& moved) {
  AskedPoints points;
  points.step = 0x1p-24;
  for (auto* coordinates : {&points.x, &points.y, &points.z}) coordinates->resize(moved.numbers.size());
  points.faces.assign(moved.numbers.size(), 0);
  put_in_place(moved, Executor(1), points);
  return points;
}

struct Tally {
  int asked = 0, hidden = 0, needlessly_hidden = 0, skipped = 0, needed_for_hidden = 0;
};

void ask(const Scene& scene, const Vector& camera, const Vector& light, const std::vector<std::uint8_t>& skippable,
         const MovedPoints& moved, const std::vector<std::uint32_t>& hidden, Tally& tally) {
  for (std::size_t k = 0; k < moved.positions.size(); ++k) {
    const GivenPoint point{moved.positions[k]};
    const bool is_hidden = std::binary_search(hidden.begin(), hidden.end(), moved.numbers[k]);
    bool by_entry = false, by_rest = false, from_camera = false, on_a_plane = false;
    for (const std::uint32_t face : scene.kept_faces()) {
      const Triangle triangle = triangle_of(scene, face);
      const int s = side(triangle, light), from = side(triangle, camera);
      from_camera = from_camera || (from != 0 && blocks(triangle, from, camera, point));
      on_a_plane = on_a_plane || side(triangle, moved.positions[k]) == 0;
      if (s == 0 || !blocks(triangle, s, light, point)) continue;
      (skippable[face] != 0 && s < 0 ? by_entry : by_rest) = true;
    }
    ASSERT_TRUE(is_hidden || !from_camera) << "a point that the camera does not see counts as seen";
    ASSERT_TRUE(is_hidden || by_rest || !by_entry)
        << "camera " << test_queries::text(camera) << ", light " << test_queries::text(light) << ", point "
        << test_queries::text(moved.positions[k]) << "; "
        << test_queries::write_failure(scene.mesh(), test_queries::text(moved.positions[k]));
    ++tally.asked;
    tally.hidden += is_hidden;
    tally.needlessly_hidden += is_hidden && !from_camera && !on_a_plane;
    tally.skipped += !is_hidden && by_entry;
    tally.needed_for_hidden += is_hidden && by_entry && !by_rest;
  }
}

TEST(MovedPoints, EntriesMayBeSkippedForThoseThatTheCameraSees) {
  constexpr std::uint64_t kSeed = 0x5eed0071;
  Random random(kSeed);
  Tally tally;
  ShadowScratch scratch;
  for (int round = 0; round < 400; ++round) {
    const Scene scene(random_solids(random));
    if (scene.kept_faces().empty()) continue;
    const double reach = 1.5 * scene.bounding_radius();
    const Vector camera = random_place(scene.mesh(), random, reach), light = random_place(scene.mesh(), random, reach);
    const std::vector<std::uint8_t> skippable = ClosedParts(scene, Executor(1)).skippable_entries(scene, camera, light);
    if (skippable.empty()) continue;
    MovedPoints moved;
    for (std::uint32_t k = 0; k < 200; ++k) {
      moved.numbers.push_back(k);
      moved.positions.push_back(random_place(scene.mesh(), random, reach));
    }
    Counters counters;
    const auto hidden = find_hidden_points(scene, camera, placed(moved), moved, scratch, counters);
    ask(scene, camera, light, skippable, moved, hidden, tally);
    if (HasFatalFailure()) return;
  }
  std::printf("seed %#llx: %d points asked, %d hidden, %d blocked by a skipped entry, %d hidden ones need it\n",
              static_cast<unsigned long long>(kSeed), tally.asked, tally.hidden, tally.skipped,
              tally.needed_for_hidden);
  EXPECT_GT(tally.asked, 20000);
  EXPECT_LT(tally.hidden, tally.asked / 4 * 3);
  EXPECT_EQ(tally.needlessly_hidden, 0);
  EXPECT_GT(tally.skipped, 1000);
  EXPECT_GT(tally.needed_for_hidden, 1000);  // or nothing would be lost by asking exits alone
}

// Normals far off the faces' own, so that points are lifted far, into other solids as well.
void add_normals(Mesh& mesh, Random& random) {
  for (const Corners& corners : mesh.triangles) {
    const DVector a(mesh.positions[corners[0]]), b(mesh.positions[corners[1]]), c(mesh.positions[corners[2]]);
    Corners normal_corners;
    for (std::uint32_t& corner : normal_corners) {
      corner = static_cast<std::uint32_t>(mesh.normals.size());
      mesh.normals.push_back(Vector(normalized(cross(b - a, c - a)) + random.in_cube()));
    }
    mesh.normal_corners.push_back(normal_corners);
  }
}

// From some views, with what a renderer keeps from one to the next.
std::vector<Image> pictures(const Scene& scene, const std::vector<View>& views, const std::vector<Light>& lights,
                            Renderer::Options options, Renderer::Strategy strategy) {
  options.strategy = strategy;
  Renderer renderer(scene, views[0], lights, options);
  std::vector<Image> images;
  for (const View& view : views) {
    renderer.set_view(view);
    images.push_back(renderer.render());
  }
  return images;
}

// Where camera and light are strictly on the same side of a face, its true points are asked: with the fix and without.
void expect_exact_where_faces_see_lights(const Scene& scene, const Vector& camera, const std::vector<Light>& lights,
                                         const Image& image, const Image& unlifted) {
  if (image.lights.empty()) return;
  const std::size_t stride = (lights.size() + 7) / 8;
  for (std::size_t pixel = 0; pixel < image.ids.size(); ++pixel) {
    if (image.ids[pixel] == kNoFace) continue;
    const Triangle face = triangle_of(scene, static_cast<std::uint32_t>(image.ids[pixel]));
    for (std::size_t l = 0; l < lights.size(); ++l) {
      if (side(face, lights[l].position) != side(face, camera)) continue;
      const std::size_t byte = pixel * stride + l / 8;
      ASSERT_EQ(image.lights[byte] >> (l % 8) & 1, unlifted.lights[byte] >> (l % 8) & 1) << "pixel " << pixel;
    }
  }
}

TEST(MovedPoints, PicturesOfSolidsAreThoseOfTheLists) {
  constexpr std::uint64_t kSeed = 0x5eed0072;
  Random random(kSeed);
  std::size_t lifted = 0;
  for (int round = 0; round < 60; ++round) {
    SCOPED_TRACE(round);
    Mesh mesh = random_solids(random);
    add_normals(mesh, random);
    const Scene scene(mesh);
    if (scene.kept_faces().empty()) continue;
    View view;
    view.look_at = Vector(scene.centre());
    view.up = Vector(random.direction());
    view.field_angle = random.between(0.1, 2.0);
    view.projection = random.chance(0.5) ? ProjectionKind::Plane : ProjectionKind::Surface;
    std::vector<View> views(3, view);
    for (View& v : views) {
      v.position = Vector(scene.centre() + random.direction() * (random.between(0.5, 3.0) * scene.bounding_radius()));
    }
    std::vector<Light> lights(static_cast<std::size_t>(random.between(1, 10)));
    for (Light& light : lights) light.position = random_place(mesh, random, 3 * scene.bounding_radius());
    Renderer::Options options;
    options.width = options.height = random.between(20, 60);
    options.threads = random.between(1, 3);
    if (random.chance(0.7)) options.planes.add(Plane::Lights);
    options.planes.add(Plane::Id);
    if (random.chance(0.5)) options.light_maps = Renderer::LightMaps::Keep;
    const auto transposed = pictures(scene, views, lights, options, Renderer::Strategy::Transposed);
    const auto by_lists = pictures(scene, views, lights, options, Renderer::Strategy::Lists);
    options.shadow_terminator_fix = false;
    const auto unlifted = pictures(scene, views, lights, options, Renderer::Strategy::Lists);
    for (std::size_t i = 0; i < views.size(); ++i) {
      const Image &a = transposed[i], &b = by_lists[i];
      ASSERT_EQ(a.lights, b.lights) << test_queries::write_failure(mesh, test_queries::text(views[i].position));
      ASSERT_EQ(std::memcmp(a.pixels.data(), b.pixels.data(), b.pixels.size() * sizeof(Color)), 0);
      for (std::size_t k = 0; k < b.lights.size(); ++k) lifted += unlifted[i].lights[k] != b.lights[k];
      expect_exact_where_faces_see_lights(scene, views[i].position, lights, b, unlifted[i]);
    }
  }
  EXPECT_GT(lifted, 1000u);  // pixels whose lights depend on it
}

TEST(MovedPoints, ArePutInTheirPlacesWithinTheError) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    Random random(seed);
    const double size = std::exp2(random.between(-60.0, 60.0));
    AskedPoints points;
    points.origin = DVector(Vector(random.in_cube() * size * std::exp2(random.between(-10.0, 10.0))));
    points.step = std::exp2(std::floor(std::log2(size))) * 0x1p-29;
    points.error = points.step;
    std::vector<DVector> truth;  // of which each point is within the error
    MovedPoints moved;
    const double farthest = random.chance(0.5) ? size : size * std::exp2(random.between(0.0, 20.0));
    for (std::uint32_t i = 0; i < 100; ++i) {
      const auto step = [&] { return static_cast<std::int32_t>(random.between(-1.0, 1.0) * 0x1p29); };
      points.x.push_back(step());
      points.y.push_back(step());
      points.z.push_back(step());
      points.faces.push_back(i);
      truth.push_back(points.origin + points.step * DVector(points.x[i], points.y[i], points.z[i]));
      if (!random.chance(0.3)) continue;
      const Vector position(points.origin + random.in_cube() * farthest);
      moved.numbers.push_back(i);
      moved.positions.push_back(position);
      truth[i] = DVector(position);
    }
    put_in_place(moved, Executor(2), points);
    for (std::uint32_t i = 0; i < 100; ++i) {
      const DVector stored = points.origin + points.step * DVector(points.x[i], points.y[i], points.z[i]);
      const double rounding = 0x1p-50 * (length(points.origin) + length(truth[i]));  // of `stored` and `truth`
      EXPECT_LE(length(stored - truth[i]), points.error + rounding);
      for (const std::int32_t q : {points.x[i], points.y[i], points.z[i]}) EXPECT_LE(std::abs(q), 1 << 30);
    }
    for (std::size_t k = 0; k < moved.numbers.size(); ++k) {
      EXPECT_EQ(points.faces[moved.numbers[k]], kNoOwnFace);
      EXPECT_EQ(moved.position_of(moved.numbers[k]), moved.positions[k]);
    }
  }
}

}  // namespace
