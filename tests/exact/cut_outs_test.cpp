// Holes that materials cut, against the referee: maps one ray and one point at a time, and whole pictures by both
// strategies, on each instruction set, with one thread and three. FACEMAP_QUERIES sets the number of rays.

#include <facemap/error.h>
#include <facemap/parallel_light.h>
#include <facemap/renderer.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "simd/target.h"
#include "support/cut_out_scenes.h"
#include "support/environment.h"
#include "support/holes.h"
#include "support/lenses.h"
#include "support/oracle.h"
#include "support/parallel_oracle.h"
#include "support/queries.h"

namespace {

using namespace facemap;
using test_scenes::TestScene;

constexpr int kLargestFaceCount = 40;

// The library's depth is sharp to 2^-30, the referee's to 2^-48; then it is rounded once.
bool is_same_depth(float depth, double truth) {
  if (std::isnan(truth) || truth < std::numeric_limits<float>::min()) return true;  // past the range of normal numbers
  if (truth > std::numeric_limits<float>::max()) return std::isinf(depth);
  const double ulp = double(std::nextafterf(depth, HUGE_VALF)) - double(depth);
  return std::fabs(depth - truth) <= 0.5 * ulp + 0x1p-29 * truth;
}

// A scene with holes and what is true of it.
struct Case {
  TestScene test;
  Scene scene;
  oracle::Holes holes;
  oracle::Oracle oracle;

  Case(const TestScene& made, Model model)
      : test(made),
        scene(std::move(model)),
        holes(scene.mesh(), scene.materials(), scene.images()),
        oracle(scene.mesh(), &holes) {}
};

class Session {
 public:
  explicit Session(std::uint64_t seed) : random_(seed) { std::printf("seed 0x%llx\n", (unsigned long long)seed); }
  ~Session() {
    std::printf("%llu scenes, %llu rays, %llu through holes, %llu shadow questions, differences: %llu\n",
                (unsigned long long)scenes_, (unsigned long long)rays_, (unsigned long long)holes_seen_,
                (unsigned long long)questions_, (unsigned long long)differences_);
  }

  void ask_maps(std::uint64_t rays) {
    while (rays_ < rays && differences_ < 10) {
      const Case at = make_case();
      try_maps(at);
    }
  }

  void ask_pictures(std::uint64_t rays) {
    while (rays_ < rays && differences_ < 10) {
      const Case at = make_case();
      try_picture(at);
    }
  }

  std::uint64_t rays() const { return rays_; }
  std::uint64_t holes_seen() const { return holes_seen_; }
  std::uint64_t differences() const { return differences_; }

 private:
  Case make_case() {
    TestScene test = test_scenes::make_any_scene(random_, kLargestFaceCount);
    ++scenes_;
    if (random_.chance(0.3)) add_solids(test);
    return Case(test, test_scenes::with_holes(test, random_));
  }

  // A closed ball and a box before all else, about where the scene is.
  void add_solids(TestScene& test) {
    const double r = 0.5 * test.radius;
    const DVector c = DVector(test.centre) + random_.in_cube() * r;
    test.mesh = test_scenes::joined(test_scenes::geodesic_sphere(1, c, r), test.mesh);
    const Vector low(c + random_.in_cube() * r), high(DVector(low) + DVector(r));
    if (low.x < high.x && low.y < high.y && low.z < high.z) {
      test.mesh = test_scenes::joined(test_scenes::box(low, high), test.mesh);
    }
  }

  void fail(const Case& at, const std::string& what) {
    if (++differences_ < 10) ADD_FAILURE() << at.test.name << ": " << what << " (scene " << scenes_ << ")";
  }

  Vector some_direction(const Case& at, const Vector& from) {
    const Mesh& mesh = at.scene.mesh();
    const auto corner = [&] { return DVector(mesh.vertex(random_.below(static_cast<int>(mesh.face_count())), 0)); };
    if (random_.chance(0.2)) return Vector(corner() - DVector(from));
    if (random_.chance(0.6)) return Vector((corner() + corner() + corner()) / 3.0 - DVector(from));
    return Vector(random_.direction());
  }

  // ---- one ray, one point ----

  void try_maps(const Case& at) {
    const Vector eye = test_scenes::make_origin(at.test, random_), lamp = test_scenes::make_origin(at.test, random_);
    Camera::Options all_around;
    all_around.field_angle = 2 * M_PI;
    all_around.width = all_around.height = random_.between(1, 60);
    const SpaceVector frame = SpaceVector::looking_along(eye, random_.direction());
    const Camera camera(at.scene, frame, all_around);
    all_around.keep_all = true;
    const Camera whole(at.scene, frame, all_around);
    const PointLight light(at.scene, lamp);
    const oracle::View eye_truth = at.oracle.from(eye), lamp_truth = at.oracle.from(lamp);
    const oracle::Oracle without(at.scene.mesh());
    const oracle::View solid_truth = without.from(eye);
    std::vector<Vector> points;
    for (int i = 0; i < 200; ++i) {
      ++rays_;
      const Vector d = some_direction(at, eye);
      const Camera::Hit hit = camera.nearest(d);
      const oracle::Hit truth = eye_truth.nearest(d);
      holes_seen_ += truth.face != solid_truth.nearest(d).face;
      if (oracle::Hit{hit.face, hit.strictly_inside, hit.tied, hit.side} != truth) {
        fail(at, "nearest " + std::to_string(hit.face) + ", the oracle " + std::to_string(truth.face));
      }
      if (whole.count_hits(d) != eye_truth.count_hits(d)) fail(at, "count of hits");
      if (truth.face == kNoFace || !hit) continue;
      if (!is_same_depth(hit.depth, eye_truth.distance(truth.face, d))) fail(at, "depth");
      const SurfacePoint seen = camera.surface_point(d, hit);
      ++questions_;
      if (light.get_lighten_up(seen) != lamp_truth.is_lit(seen)) fail(at, "light on what is seen");
      points.push_back(Vector(DVector(eye) + DVector(d) * random_.between(0.0, 2.0)));
      if (!(std::isfinite(points.back().x + points.back().y + points.back().z))) points.pop_back();
    }
    try_points(at, light, lamp_truth, points);
    try_parallel(at, eye, camera, points);
  }

  // Parallel rays, and parallel light on what a camera sees.
  void try_parallel(const Case& at, const Vector& eye, const Camera& camera, const std::vector<Vector>& points) {
    Vector along = some_direction(at, eye);
    if (along == Vector(0) || !std::isfinite(along.x + along.y + along.z)) along = Vector(random_.direction());
    const ParallelLight light(at.scene, along);
    const oracle::ParallelView truth(at.oracle, along);
    for (const Vector& point : points) {
      ++rays_;
      const Camera::Hit hit = light.nearest(point);
      if (oracle::Hit{hit.face, hit.strictly_inside, hit.tied, hit.side} != truth.nearest(point)) {
        fail(at, "nearest along parallel rays");
      }
      const Vector d = some_direction(at, eye);
      const Camera::Hit seen = camera.nearest(d);
      ++questions_;
      if (!seen) continue;
      const SurfacePoint surface = camera.surface_point(d, seen);
      if (light.get_lighten_up(surface) != truth.is_lit(surface)) fail(at, "parallel light on what is seen");
    }
    try_points(at, light, truth, points);
  }

  template <class Map, class Truth>
  void try_points(const Case& at, const Map& light, const Truth& truth, const std::vector<Vector>& points) {
    std::vector<std::uint8_t> lit(points.size());
    light.get_lighten_up(points, lit);
    for (std::size_t i = 0; i < points.size(); ++i) {
      ++questions_;
      if ((lit[i] != 0) != truth.is_lit(points[i], {})) fail(at, "light on one of many points");
      PointLight::On on;
      if (random_.chance(0.5)) on.tolerance = static_cast<float>(at.test.radius * random_.between(0.0, 0.2));
      if (on.tolerance == 0 && random_.chance(0.5) && !at.oracle.kept_faces().empty()) {
        const auto count = static_cast<int>(at.oracle.kept_faces().size());
        on.face = at.oracle.kept_faces()[static_cast<std::size_t>(random_.below(count))];
      }
      if (light.get_lighten_up(points[i], on) != truth.is_lit(points[i], on)) fail(at, "light on a point");
    }
  }

  // ---- pictures ----

  View make_view(const Case& at) {
    View view;
    view.position = test_scenes::make_origin(at.test, random_);
    view.look_at = at.test.centre;
    if (random_.chance(0.5)) view.look_at = Vector(DVector(view.position) + DVector(some_direction(at, view.position)));
    view.up = Vector(random_.direction());
    view.projection = random_.chance(0.5) ? ProjectionKind::Plane : ProjectionKind::Surface;
    view.field_angle = random_.chance(0.3) ? std::exp2(random_.between(-12.0, 0.0)) : random_.between(0.1, 3.0);
    return view;
  }

  void try_picture(const Case& at) {
    std::vector<Light> lights(static_cast<std::size_t>(random_.between(1, 9)));
    for (Light& light : lights) {
      light.position = test_scenes::make_origin(at.test, random_);
      if (random_.chance(0.3)) {
        light.kind = Light::Kind::Directional;
        light.direction = Vector(random_.direction());
      }
    }
    Renderer::Options options;
    options.width = random_.between(1, 30);
    options.height = random_.between(1, 30);
    options.samples = random_.chance(0.2) ? 2 : 1;
    View view = make_view(at);
    if (random_.chance(0.3)) {
      view.lens = random_lens(random_, 30).lens;
      options.width = view.lens->width();
      options.height = view.lens->height();
    }
    if (random_.chance(0.2)) options.map_memory = 1;  // bands of few rows
    if (random_.chance(0.5)) options.light_maps = Renderer::LightMaps::Keep;
    std::optional<Image> first;
    for (const auto strategy : {Renderer::Strategy::Transposed, Renderer::Strategy::Lists}) {
      for (const int threads : {1, 3}) {
        options.strategy = strategy;
        options.threads = threads;
        Image image;
        try {
          Renderer renderer(at.scene, view, lights, options);
          if (threads == 3) renderer.look();  // what is kept of the lights is asked again
          image = renderer.look();
        } catch (const Error&) {  // no view looks at its own position, or along its up direction
          EXPECT_ANY_THROW(SpaceVector::looking_at(view.position, view.look_at, view.up));
          return;
        }
        if (!first) {
          compare(at, view, lights, options, image);
          first = image;
        } else if (image.ids != first->ids || image.lights != first->lights) {
          fail(at, "strategy " + std::to_string(static_cast<int>(strategy)) + " with " + std::to_string(threads) +
                       " threads shows something else");
        }
      }
    }
  }

  void compare(const Case& at, const View& view, const std::vector<Light>& lights, const Renderer::Options& options,
               const Image& image) {
    const oracle::View eye_truth = at.oracle.from(view.position);
    std::vector<oracle::View> lamp_truths;
    std::vector<oracle::ParallelView> sun_truths;
    for (const Light& light : lights) {
      lamp_truths.push_back(at.oracle.from(light.position));
      sun_truths.emplace_back(at.oracle, light.kind == Light::Kind::Directional ? light.direction : Vector(0, 0, 1));
    }
    const SpaceVector frame = SpaceVector::looking_at(view.position, view.look_at, view.up);
    const Lens lens = view.lens ? *view.lens
                      : view.projection == ProjectionKind::Plane
                          ? Lens::plane(view.field_angle, options.width, options.height)
                          : Lens::surface(view.field_angle, options.width, options.height);
    const Mesh& mesh = at.scene.mesh();
    for (int y = 0; y < image.height; ++y) {
      for (int x = 0; x < image.width; ++x) {
        const int n = options.samples;
        const MapPoint point(x / n + (x % n + 0.5) / n, y / n + (y % n + 0.5) / n);
        Vector d(0);
        if (const auto local = lens.direction(point)) d = Vector(frame.world_from_local(*local));
        const std::size_t i = static_cast<std::size_t>(y) * image.width + x;
        ++rays_;
        const oracle::Hit truth = eye_truth.nearest(d);
        std::string expected = std::to_string(truth.face) + " ", actual = std::to_string(image.ids[i]) + " ";
        for (std::size_t l = 0; l < lights.size(); ++l) {
          bool is_lit = false;
          if (truth.face != kNoFace) {
            ++questions_;
            const std::array<Vector, 3> corners = {mesh.vertex(truth.face, 0), mesh.vertex(truth.face, 1),
                                                   mesh.vertex(truth.face, 2)};
            const SurfacePoint seen{view.position, d, corners, truth.face, truth.side};
            const bool is_sun = lights[l].kind == Light::Kind::Directional;
            is_lit = is_sun ? sun_truths[l].is_lit(seen) : lamp_truths[l].is_lit(seen);
          }
          expected += is_lit ? '1' : '0';
          actual += image.lights[i * image.light_bytes() + l / 8] >> (l % 8) & 1 ? '1' : '0';
        }
        if (expected != actual) {
          fail(at, "pixel " + std::to_string(x) + " " + std::to_string(y) + ": " + actual + ", the oracle " + expected);
        }
      }
    }
  }

  Random random_;
  std::uint64_t scenes_ = 0, rays_ = 0, holes_seen_ = 0, questions_ = 0, differences_ = 0;
};

TEST(CutOuts, MapsEqualTheOracle) {
  Session session(number_from_environment("FACEMAP_SEED", 0x5eed0070));
  const std::uint64_t rays = number_from_environment("FACEMAP_QUERIES", 60'000);
  session.ask_maps(rays);
  EXPECT_EQ(session.differences(), 0u);
  EXPECT_GT(20 * session.holes_seen(), session.rays()) << "few rays meet a hole";
}

TEST(CutOuts, PicturesEqualTheOracle) {
  Session session(number_from_environment("FACEMAP_SEED", 0x5eed0071));
  session.ask_pictures(number_from_environment("FACEMAP_QUERIES", 60'000));
  EXPECT_EQ(session.differences(), 0u);
}

}  // namespace
