// Whole pictures of hard little scenes against the referee: what each ray sees and which lights reach it, for each
// strategy, instruction set and number of threads. FACEMAP_QUERIES sets the number of rays.

#include <facemap/error.h>
#include <facemap/renderer.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <optional>
#include <string>
#include <vector>

#include "render/light_sources.h"
#include "render/parallel_eye.h"
#include "scene/surface_coordinates.h"
#include "simd/target.h"
#include "support/environment.h"
#include "support/lenses.h"
#include "support/oracle.h"
#include "support/parallel_oracle.h"
#include "support/queries.h"
#include "support/random.h"
#include "support/scenes.h"

namespace {

using namespace facemap;
using test_scenes::TestScene;

constexpr int kLargestFaceCount = 60;

struct Tally {
  std::uint64_t pictures = 0, rays = 0, hits = 0, shadow_questions = 0, unreached = 0, differences = 0;
};

std::string text(const Light& light) {
  return " light " + std::to_string(static_cast<int>(light.kind)) + " " + test_queries::text(light.position) + " " +
         test_queries::text(light.direction) + " " + std::to_string(light.inner_angle) + " " +
         std::to_string(light.outer_angle) + " " + std::to_string(light.range);
}

// What a light's bit must say of a point: nothing stands between, by the referee, and cone and range hold it, which is
// one sequence of doubles by definition.
class LightTruth {
 public:
  LightTruth(const oracle::Oracle& oracle, const Light& light)
      : source_(light_sources({light}, Renderer::Falloff::Constant)[0]) {
    if (light.kind == Light::Kind::Directional) {
      along_.emplace(oracle, light.direction);
    } else {
      from_.emplace(oracle.from(light.position));
    }
  }

  bool is_out_of_reach(const Mesh& mesh, const SurfacePoint& point) const {
    const FaceCorners face = corners_of(mesh, static_cast<std::size_t>(point.face));
    const DVector weights = barycentric(face, point_on_plane(face, DVector(point.origin), DVector(point.direction)));
    return !reaches(source_, weighted(face.v, weights));
  }

  bool is_lit(const Mesh& mesh, const SurfacePoint& point) const {
    return !is_out_of_reach(mesh, point) && (along_ ? along_->is_lit(point) : from_->is_lit(point));
  }

 private:
  simd::LightSource source_;
  std::optional<oracle::View> from_;
  std::optional<oracle::ParallelView> along_;
};

class Session {
 public:
  explicit Session(std::uint64_t seed) : random_(seed) { std::printf("seed 0x%llx\n", (unsigned long long)seed); }
  ~Session() { simd::set_active_target(simd::supported_targets().back()); }

  // At least so many rays, and more, up to twice as many, until a quarter of the number has hit something.
  const Tally& ask(std::uint64_t rays) {
    const auto is_open = [&] { return tally_.rays < rays || (4 * tally_.hits < rays && tally_.rays < 2 * rays); };
    while (is_open() && tally_.differences < 20) ask_picture();
    std::printf("%llu pictures, %llu rays, %llu hits, %llu shadow questions, %llu out of reach, differences: %llu\n",
                (unsigned long long)tally_.pictures, (unsigned long long)tally_.rays, (unsigned long long)tally_.hits,
                (unsigned long long)tally_.shadow_questions, (unsigned long long)tally_.unreached,
                (unsigned long long)tally_.differences);
    return tally_;
  }

 private:
  View make_view(const TestScene& test) {
    View view;
    view.position = test_scenes::make_origin(test, random_);
    view.look_at = test.centre;
    // Aimed at a vertex or an edge, whose direction then lies in the midst of the picture.
    const Mesh& mesh = test.mesh;
    const Vector a = mesh.vertex(random_.below(static_cast<int>(mesh.face_count())), random_.below(3));
    const Vector b = mesh.vertex(random_.below(static_cast<int>(mesh.face_count())), random_.below(3));
    if (random_.chance(0.5)) view.look_at = a;
    if (random_.chance(0.2)) view.look_at = Vector((DVector(a) + DVector(b)) * 0.5);
    view.up = Vector(random_.direction());
    if (test.lattice > 0 && random_.chance(0.5)) look_along_an_axis(test, a, view);
    const bool is_plane = random_.chance(0.5);
    view.projection = is_plane ? ProjectionKind::Plane : ProjectionKind::Surface;
    view.field_angle =
        random_.chance(0.3) ? std::exp2(random_.between(-20.0, 0.0)) : random_.between(0.1, is_plane ? 3.0 : 2 * M_PI);
    if (random_.chance(0.15)) {
      view.is_parallel = true;
      const DVector size = DVector(Scene(test.mesh).upper()) - DVector(Scene(test.mesh).lower());
      view.height = std::max({size.x, size.y, size.z, 1e-30}) * std::exp2(random_.between(-6.0, 1.0));
    }
    return view;
  }

  // Then the rays of the middle row and column lie in planes of the lattice, and meet its edges and vertices exactly.
  void look_along_an_axis(const TestScene& test, const Vector& vertex, View& view) {
    const int axis = random_.below(3);
    view.look_at = view.position = vertex;
    view.position[axis] += static_cast<float>(test.lattice * random_.between(1, 12) * (random_.chance(0.5) ? 1 : -1));
    view.up = Vector(0);
    view.up[(axis + 1) % 3] = 1;
  }

  void ask_picture() {
    const TestScene test = test_scenes::make_any_scene(random_, kLargestFaceCount);
    const Scene scene(test.mesh);
    View view = make_view(test);
    std::vector<Light> lights(static_cast<std::size_t>(random_.between(0, 10)));
    for (Light& light : lights) {
      light.position = test_scenes::make_origin(test, random_);
      if (random_.chance(0.5)) test_scenes::make_any_kind(test, random_, light);
    }
    Renderer::Options options;
    options.width = random_.between(1, 40);
    options.height = random_.between(1, 40);
    if (random_.chance(0.3)) set_lens(view, options);
    options.samples = random_.chance(0.2) ? random_.between(2, 3) : 1;
    if (random_.chance(0.2)) options.crop = any_part(options);
    options.threads = random_.between(1, 3);
    if (random_.chance(0.3)) options.map_memory = 1;  // bands of few rows
    if (random_.chance(0.5)) options.light_maps = Renderer::LightMaps::Keep;
    options.strategy = random_.chance(0.8) ? Renderer::Strategy::Transposed : Renderer::Strategy::Lists;
    const std::vector<simd::Target> targets = simd::supported_targets();
    simd::set_active_target(targets[static_cast<std::size_t>(random_.below(static_cast<int>(targets.size())))]);
    try {
      Renderer renderer(scene, view, lights, options);
      if (random_.chance(0.2)) look_elsewhere(test, renderer);  // what is kept is made for another view
      renderer.set_view(view);
      compare(test, scene, view, lights, options, renderer.look());
      ++tally_.pictures;
    } catch (const Error&) {  // no view looks at its own position, or along its up direction
      EXPECT_ANY_THROW(SpaceVector::looking_at(view.position, view.look_at, view.up));
    }
  }

  void set_lens(View& view, Renderer::Options& options) {
    view.lens = random_lens(random_, 40).lens;
    options.width = view.lens->width();
    options.height = view.lens->height();
    view.is_parallel = false;
  }

  PixelBox any_part(const Renderer::Options& options) {
    const int x = random_.below(options.width), y = random_.below(options.height);
    return {x, y, random_.between(1, options.width - x), random_.between(1, options.height - y)};
  }

  void look_elsewhere(const TestScene& test, Renderer& renderer) {
    try {
      View elsewhere = make_view(test);
      elsewhere.is_parallel = false;
      renderer.set_view(elsewhere);
      renderer.look();
    } catch (const Error&) {  // as in ask_picture
    }
  }

  void compare(const TestScene& test, const Scene& scene, const View& view, const std::vector<Light>& lights,
               const Renderer::Options& options, const Image& image) {
    const oracle::Oracle oracle(scene.mesh());
    const oracle::View camera_truth = oracle.from(view.position);
    std::vector<LightTruth> light_truths;
    for (const Light& light : lights) light_truths.emplace_back(oracle, light);
    const SpaceVector frame = SpaceVector::looking_at(view.position, view.look_at, view.up);
    const Lens lens = view.lens
                          ? *view.lens
                          : Lens(Projection(view.is_parallel ? ProjectionKind::Plane : view.projection,
                                            view.is_parallel ? 1 : view.field_angle, options.width, options.height));
    std::optional<ParallelEye> eye;
    if (view.is_parallel) eye.emplace(scene, view, options);
    const PixelBox made = options.crop.value_or(PixelBox{0, 0, options.width, options.height});
    ASSERT_EQ(image.width, made.width * options.samples);
    ASSERT_EQ(image.height, made.height * options.samples);
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const int n = options.samples;
        const MapPoint point(made.x + x / n + (x % n + 0.5) / n, made.y + y / n + (y % n + 0.5) / n);
        Eye::Ray ray = {view.position, Vector(0)};
        if (const auto local = lens.direction(point)) ray.direction = Vector(frame.world_from_local(*local));
        if (eye) ray = eye->ray(point);
        const auto& [K, d] = ray;
        const std::size_t i = static_cast<std::size_t>(y) * image.width + x;
        ++tally_.rays;
        const oracle::Hit truth = eye ? oracle.from(K).nearest(d) : camera_truth.nearest(d);
        std::string expected = std::to_string(truth.face), actual = std::to_string(image.ids[i]);
        for (std::size_t l = 0; l < lights.size(); ++l) {
          bool is_lit = false;
          if (truth.face != kNoFace) {
            const Mesh& mesh = scene.mesh();
            is_lit = light_truths[l].is_lit(
                mesh, {K,
                       d,
                       {mesh.vertex(truth.face, 0), mesh.vertex(truth.face, 1), mesh.vertex(truth.face, 2)},
                       truth.face,
                       truth.side});
            tally_.unreached += light_truths[l].is_out_of_reach(mesh, {K, d, {}, truth.face, 0});
            ++tally_.shadow_questions;
          }
          expected += is_lit ? '1' : '0';
          actual += image.lights[i * image.light_bytes() + l / 8] >> (l % 8) & 1 ? '1' : '0';
        }
        tally_.hits += truth.face != kNoFace;
        if (expected == actual) continue;
        ++tally_.differences;
        std::string where = "camera " + test_queries::text(view.position) + " look at " +
                            test_queries::text(view.look_at) + " up " + test_queries::text(view.up) +
                            (view.lens          ? " lens " + std::to_string(static_cast<int>(view.lens->kind()))
                             : view.is_parallel ? " parallel " + std::to_string(view.height)
                             : view.projection == ProjectionKind::Plane ? " plane "
                                                                        : " surface ") +
                            std::to_string(view.field_angle) + " size " + std::to_string(options.width) + "x" +
                            std::to_string(options.height) + "x" + std::to_string(n);
        for (const Light& light : lights) where += text(light);
        ADD_FAILURE() << test.name << " pixel " << x << " " << y << ": " << actual << ", the oracle " << expected
                      << " (tied " << truth.tied << ", inside " << truth.strictly_inside << "), target "
                      << simd::name_of(simd::active_target()) << ", " << options.threads << " threads, strategy "
                      << static_cast<int>(options.strategy) << "; " << test_queries::write_failure(scene.mesh(), where);
        if (tally_.differences >= 20) return;
      }
    }
  }

  Random random_;
  Tally tally_;
};

TEST(WholePictures, EqualTheOracle) {
  Session session(number_from_environment("FACEMAP_SEED", 0x5eed0060));
  const std::uint64_t rays = number_from_environment("FACEMAP_QUERIES", 300'000);
  const Tally& tally = session.ask(rays);
  EXPECT_EQ(tally.differences, 0u);
  EXPECT_GE(4 * tally.hits, rays);
  EXPECT_GT(100 * tally.unreached, tally.shadow_questions);
}

// An L-shaped prism, closed, of eight caps and twelve sides; `first_side` comes first among the sides.
Mesh l_prism(int first_side) {
  const int x[] = {0, 4, 4, 1, 1, 0}, y[] = {0, 0, 1, 1, 4, 4};
  Mesh mesh;
  for (const int z : {-2, 2}) {
    for (int i = 0; i < 6; ++i) mesh.positions.push_back(Vector(x[i], y[i], z));
  }
  for (int k = 0; k < 6; ++k) {
    const auto a = static_cast<std::uint32_t>((first_side + k) % 6), b = (a + 1) % 6;
    mesh.triangles.push_back({a, b, b + 6});
    mesh.triangles.push_back({a, b + 6, a + 6});
  }
  for (const auto& [a, b, c] : {Corners{0, 1, 2}, Corners{0, 2, 3}, Corners{0, 3, 4}, Corners{0, 4, 5}}) {
    mesh.triangles.push_back({a + 6, b + 6, c + 6});
    mesh.triangles.push_back({a, c, b});
  }
  return mesh;
}

// The middle ray meets the inner edge. From the light the prism's arm lies before that point, but its only exit there
// passes through the point itself: a point that is not strictly inside its face must ask entry faces too.
TEST(WholePictures, APointOnAnEdgeOfAClosedPartAsksAllFaces) {
  int seen_on_the_step = 0;
  for (int first_side = 0; first_side < 6; ++first_side) {
    const Scene scene(l_prism(first_side));
    View view;
    view.position = {5, 5, 0};
    view.look_at = {1, 1, 0};
    view.up = {0, 0, 1};
    Renderer::Options options;
    options.width = options.height = 3;
    options.strategy = Renderer::Strategy::Transposed;
    const Image image = Renderer(scene, view, {{{-6, 4, 0}}, {{2, 6, 0}}}, options).look();
    const FaceId face = image.ids[4];
    ASSERT_NE(face, kNoFace);
    if (scene.mesh().vertex(face, 0).y != 1 || scene.mesh().vertex(face, 2).y != 1) continue;  // the other side won
    ++seen_on_the_step;
    EXPECT_EQ(image.lights[4], 2) << "the first light is behind the arm, the second in front of all";
  }
  EXPECT_GT(seen_on_the_step, 0);
}

// A ball and a leaf behind it stand at the near end of a floor as long as 256 times their height. Beside its length
// they are so near to the light that points there have no place on the raster of its kept map. The ball is closed, so
// that its faces towards the light are left out, and those behind them because the map has them in the dark: such
// points are to ask all faces.
TEST(WholePictures, PointsTooNearToALightAskMoreThanItsKeptMap) {
  constexpr float kHalf = 0x1p-8f;
  Mesh mesh = test_scenes::geodesic_sphere(3, DVector(0, 0, 0.5 * kHalf), 0.5 * kHalf);
  test_scenes::add_triangle(mesh, {-kHalf, -kHalf, 2 * kHalf}, {kHalf, -kHalf, 2 * kHalf}, {0, kHalf, 2 * kHalf});
  test_scenes::add_triangle(mesh, {-kHalf, -kHalf, 0}, {kHalf, -kHalf, 1}, {-kHalf, -kHalf, 1});
  const Scene scene(mesh);
  const Light light{{0, 0, -4 * kHalf}};
  View view;
  view.position = {0, 4 * kHalf, -4 * kHalf};
  view.look_at = {0, 0, 2 * kHalf};
  view.up = {0, 1, 0};
  view.field_angle = 1.5;
  Renderer::Options options;
  options.width = options.height = 256;
  options.strategy = Renderer::Strategy::Transposed;
  options.light_maps = Renderer::LightMaps::None;
  const Image image = Renderer(scene, view, {light}, options).look();
  const auto leaf = static_cast<FaceId>(mesh.face_count() - 2);
  std::size_t in_shadow = 0, beyond = 0;
  for (std::size_t i = 0; i < image.ids.size(); ++i) {
    in_shadow += image.ids[i] == leaf && image.lights[i] == 0;
    beyond += image.ids[i] > leaf;
  }
  EXPECT_GT(in_shadow, 20u);
  EXPECT_GT(beyond, 20u);
  options.light_maps = Renderer::LightMaps::Keep;
  EXPECT_TRUE(Renderer(scene, view, {light}, options).look().lights == image.lights);
}

}  // namespace
