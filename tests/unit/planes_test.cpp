#include <facemap/renderer.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <glm/geometric.hpp>

#include "support/random.h"

namespace {

using namespace facemap;

/// Directions and results are rounded to float32, 2^-24 each; on planes as little tilted as these a ray that is off by
/// one part in so many meets them at most four parts off. Relative to the distance.
constexpr double kRounding = 4 * 0x1p-23;

constexpr double kDistance = 10;  // of the camera from the plane's middle
constexpr int kSide = 48;

PlaneSet every_plane() {
  PlaneSet planes;
  for (const Plane plane : all_planes()) planes.add(plane);
  return planes;
}

/// The square -2..2 of x and y on the plane z = x / 2, as two triangles: one has a material, each is an object. u and v
/// go from 0 to 1 with x and y; the normals in the file lean towards +y. Its back is turned to the camera.
Model tilted_square() {
  Model model;
  Mesh& mesh = model.mesh;
  mesh.positions = {{-2, -2, -1}, {2, -2, 1}, {2, 2, 1}, {-2, 2, -1}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}};
  mesh.texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.texture_corners = {{0, 2, 1}, {kNoIndex, kNoIndex, kNoIndex}};
  mesh.normals = {{-1, 1, 2}};
  mesh.normal_corners = {{0, 0, 0}, {0, 0, 0}};
  mesh.triangle_materials = {0, kNoIndex};
  model.materials.resize(1);
  model.materials[0].diffuse = {0.25f, 0.5f, 0.75f};
  model.objects = {"lower", "upper"};
  model.triangle_objects = {0, 1};
  return model;
}

View before_it() {
  View view;
  view.position = {0, 0, kDistance};
  view.look_at = {0, 0, 0};
  view.projection = ProjectionKind::Plane;
  return view;
}

Renderer::Options with_planes(PlaneSet planes) {
  Renderer::Options options;
  options.width = options.height = kSide;
  options.planes = planes;
  return options;
}

/// What the geometry says of a pixel's centre.
struct Truth {
  DVector ray;  // 1 along the sight
  DVector position;
  bool hits;

  Truth(int x, int y) {
    const double scale = 2 * std::tan(before_it().field_angle / 2) / kSide;
    ray = {(x + 0.5 - kSide / 2.0) * scale, (kSide / 2.0 - y - 0.5) * scale, -1};
    const double t = kDistance / (ray.x / 2 - ray.z);  // kDistance + t ray.z = t ray.x / 2
    position = DVector(0, 0, kDistance) + ray * t;
    hits = std::fabs(position.x) < 2 && std::fabs(position.y) < 2;
  }
  bool is_lower() const { return position.y <= position.x; }  // on the edge the lower id is seen
};

void expect_near(const Vector& seen, const DVector& truth, double tolerance) {
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(seen[k], truth[k], tolerance);
}

class TiltedSquare : public testing::Test {
 protected:
  TiltedSquare()
      : scene_(tilted_square()),
        lights_{{{0, 0, 5}}, {{0, 0, -5}}},  // one before it, one behind
        image_(Renderer(scene_, before_it(), lights_, with_planes(every_plane())).render()) {}

  /// Calls check(pixel, truth) for all pixels that see the square, and returns how many there are.
  template <class Check>
  int for_each_hit(const Check& check) const {
    int count = 0;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        const Truth truth(x, y);
        if (!truth.hits) continue;
        ++count;
        check(static_cast<std::size_t>(y * kSide + x), truth);
      }
    }
    return count;
  }

  Scene scene_;
  std::vector<Light> lights_;
  Image image_;
};

TEST_F(TiltedSquare, FacesObjectsAndMaterialsHaveNumbers) {
  EXPECT_GT(for_each_hit([&](std::size_t i, const Truth& truth) {
              EXPECT_EQ(image_.ids[i], truth.is_lower() ? 0 : 1);
              EXPECT_EQ(image_.objects[i], truth.is_lower() ? 0 : 1);
              EXPECT_EQ(image_.materials[i], truth.is_lower() ? 0 : -1);
            }),
            kSide);
}

TEST_F(TiltedSquare, RangeIsAlongTheRayAndZAlongTheSight) {
  for_each_hit([&](std::size_t i, const Truth& truth) {
    const DVector offset = truth.position - DVector(0, 0, kDistance);
    EXPECT_NEAR(image_.depths[i], std::sqrt(glm::dot(offset, offset)), kRounding * kDistance);
    EXPECT_NEAR(image_.zs[i], -offset.z, kRounding * kDistance);
    expect_near(image_.positions[i], truth.position, kRounding * kDistance);
  });
}

TEST_F(TiltedSquare, NormalsAreOnTheSideThatIsSeen) {
  const DVector plane = DVector(-1, 0, 2) / std::sqrt(5.0), smooth = DVector(-1, 1, 2) / std::sqrt(6.0);
  for_each_hit([&](std::size_t i, const Truth&) {
    expect_near(image_.face_normals[i], plane, kRounding);
    expect_near(image_.normals[i], smooth, kRounding);
  });
  Renderer::Options options = with_planes({Plane::Normal});
  options.normals = Renderer::Normals::Flat;
  const Image flat = Renderer(scene_, before_it(), lights_, options).render();
  EXPECT_EQ(flat.normals, image_.face_normals);
  EXPECT_TRUE(flat.ids.empty() && flat.face_normals.empty());
}

TEST_F(TiltedSquare, SurfacesShowTheirColourAndCoordinates) {
  for_each_hit([&](std::size_t i, const Truth& truth) {
    EXPECT_EQ(image_.albedos[i], (truth.is_lower() ? Color{0.25f, 0.5f, 0.75f} : Color{1, 1, 1}));
    if (!truth.is_lower()) {
      EXPECT_TRUE(std::isnan(image_.uvs[i].x) && std::isnan(image_.uvs[i].y)) << "the face has none";
      return;
    }
    EXPECT_NEAR(image_.uvs[i].x, truth.position.x / 4 + 0.5, kRounding * kDistance / 4);
    EXPECT_NEAR(image_.uvs[i].y, truth.position.y / 4 + 0.5, kRounding * kDistance / 4);
  });
}

TEST_F(TiltedSquare, ShadowsCountTheLightsThatAreNotThere) {
  for_each_hit([&](std::size_t i, const Truth&) {
    EXPECT_EQ(image_.lights[i], 1);
    EXPECT_EQ(image_.shadows[i], 1);
  });
}

TEST_F(TiltedSquare, WhereNoFaceIsSeenEachPlaneSaysSo) {
  ASSERT_FALSE(Truth(0, 0).hits);
  EXPECT_EQ(image_.ids[0], kNoFace);
  EXPECT_EQ(image_.depths[0], INFINITY);
  EXPECT_EQ(image_.zs[0], INFINITY);
  EXPECT_TRUE(std::isnan(image_.positions[0].x) && std::isnan(image_.positions[0].y));
  EXPECT_EQ(image_.normals[0], Vector(0));
  EXPECT_EQ(image_.face_normals[0], Vector(0));
  EXPECT_EQ(image_.albedos[0], (Color{0, 0, 0}));
  EXPECT_TRUE(std::isnan(image_.uvs[0].x) && std::isnan(image_.uvs[0].y));
  EXPECT_EQ(image_.objects[0], -1);
  EXPECT_EQ(image_.materials[0], -1);
  EXPECT_EQ(image_.lights[0], 0);
  EXPECT_EQ(image_.shadows[0], -1);
}

TEST_F(TiltedSquare, BehindTheCameraZIsNegative) {
  View away = before_it();
  away.look_at = {0, 0, 20};
  away.projection = ProjectionKind::Surface;
  away.field_angle = 2 * M_PI;
  const Image image = Renderer(scene_, away, lights_, with_planes({Plane::Z, Plane::Depth})).render();
  int seen = 0;
  for (std::size_t i = 0; i < image.zs.size(); ++i) {
    if (std::isinf(image.depths[i])) continue;
    ++seen;
    EXPECT_LT(image.zs[i], 0);
    EXPECT_LE(-image.zs[i], image.depths[i]);
  }
  EXPECT_GT(seen, 0);
}

template <class Value>
bool same_bits(const std::vector<Value>& a, const std::vector<Value>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

void expect_same_planes(const Image& a, const Image& b) {
  EXPECT_EQ(a.ids, b.ids);
  EXPECT_TRUE(same_bits(a.depths, b.depths));
  EXPECT_TRUE(same_bits(a.zs, b.zs));
  EXPECT_TRUE(same_bits(a.positions, b.positions));
  EXPECT_TRUE(same_bits(a.normals, b.normals));
  EXPECT_TRUE(same_bits(a.face_normals, b.face_normals));
  EXPECT_TRUE(same_bits(a.albedos, b.albedos));
  EXPECT_TRUE(same_bits(a.uvs, b.uvs));
  EXPECT_EQ(a.objects, b.objects);
  EXPECT_EQ(a.materials, b.materials);
  EXPECT_EQ(a.lights, b.lights);
  EXPECT_EQ(a.shadows, b.shadows);
}

/// Triangles here and there, with normals, texture coordinates, colours and materials.
Model random_model(Random& random) {
  Model model;
  Mesh& mesh = model.mesh;
  const int faces = random.between(1, 60);
  model.materials.resize(3);
  model.objects = {"a", "b"};
  for (int i = 0; i < faces; ++i) {
    const DVector middle = random.in_cube() * 3.0;
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int k = 0; k < 3; ++k) {
      mesh.positions.emplace_back(middle + random.in_cube());
      mesh.normals.emplace_back(random.direction());
      mesh.colours.emplace_back(random.unit(), random.unit(), random.unit());
      mesh.texture_coordinates.emplace_back(random.unit(), random.unit());
    }
    const Corners corners = {first, first + 1, first + 2}, none = {kNoIndex, kNoIndex, kNoIndex};
    mesh.triangles.push_back(corners);
    mesh.normal_corners.push_back(random.chance(0.5) ? corners : none);
    mesh.texture_corners.push_back(random.chance(0.5) ? corners : none);
    mesh.triangle_materials.push_back(random.chance(0.2) ? kNoIndex : static_cast<std::uint32_t>(random.below(3)));
    model.triangle_objects.push_back(random.chance(0.2) ? kNoIndex : static_cast<std::uint32_t>(random.below(2)));
  }
  return model;
}

TEST(Planes, AreTheSameByEachStrategyAndForEachNumberOfSamplesAndThreads) {
  constexpr std::uint64_t kSeed = 20260;
  std::printf("seed %llu\n", static_cast<unsigned long long>(kSeed));
  Random random(kSeed);
  for (int round = 0; round < 12; ++round) {
    SCOPED_TRACE(round);
    const Scene scene(random_model(random));
    View view;
    view.position = Vector(random.direction() * 6.0);
    view.look_at = {0, 0, 0};
    view.field_angle = random.between(0.5, 6.0);
    if (round % 3 == 1) view.lens = Lens::equirectangular(kSide, kSide);
    if (round % 3 == 2) view.lens = Lens::opencv_fisheye({20, 20, 24, 24}, {0.1, 0.01, 0, 0}, kSide, kSide);
    std::vector<Light> lights(static_cast<std::size_t>(random.between(1, 10)));
    for (Light& light : lights) light.position = Vector(random.direction() * 5.0);
    Renderer::Options options = with_planes(every_plane());
    options.threads = 1;
    options.strategy = Renderer::Strategy::Transposed;
    const Image first = Renderer(scene, view, lights, options).render();
    options.strategy = Renderer::Strategy::Lists;
    const Image lists = Renderer(scene, view, lights, options).render();
    expect_same_planes(first, lists);
    options.threads = 3;
    options.samples = 2;
    expect_same_planes(first, Renderer(scene, view, lights, options).render());
    options.sampling = Renderer::Sampling::Edges;
    expect_same_planes(first, Renderer(scene, view, lights, options).render());
    options = with_planes({Plane::Depth, Plane::Normal, Plane::Shadows});
    options.crop = PixelBox{5, 7, 31, 20};
    const Image part = Renderer(scene, view, lights, options).render();
    for (int y = 0; y < 20; ++y) {
      for (int x = 0; x < 31; ++x) {
        const auto i = static_cast<std::size_t>(y * 31 + x), whole = static_cast<std::size_t>((y + 7) * kSide + x + 5);
        EXPECT_EQ(part.depths[i], first.depths[whole]);
        EXPECT_EQ(part.normals[i], first.normals[whole]);
        EXPECT_EQ(part.shadows[i], first.shadows[whole]);
      }
    }
    options = with_planes({});
    const Image plain = Renderer(scene, view, lights, options).render();
    EXPECT_EQ(plain.pixels, first.pixels) << "planes change nothing";
    expect_same_planes(plain, Image());
  }
}

/// A cube about the origin, seen from there.
Mesh room() {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back({i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1});
  for (const Corners& c : {Corners{0, 1, 3},
                           {0, 3, 2},
                           {4, 5, 7},
                           {4, 7, 6},
                           {0, 1, 5},
                           {0, 5, 4},
                           {2, 3, 7},
                           {2, 7, 6},
                           {0, 2, 6},
                           {0, 6, 4},
                           {1, 3, 7},
                           {1, 7, 5}}) {
    mesh.triangles.push_back(c);
  }
  return mesh;
}

TEST(Planes, AtTheRimOfAWideFieldDepthsAgreeWithGeometry) {
  const Scene scene(room());
  View view;
  view.position = {0, 0, 0};
  view.look_at = {0, 0, -1};
  view.field_angle = 220 * M_PI / 180;
  for (const auto strategy : {Renderer::Strategy::Lists, Renderer::Strategy::Transposed}) {
    Renderer::Options options = with_planes({Plane::Depth, Plane::Z, Plane::Position});
    options.strategy = strategy;
    const Image image = Renderer(scene, view, {{{0, 0.5f, 0}}}, options).render();
    int behind = 0;
    for (int y = 0; y < kSide; ++y) {
      for (int x = 0; x < kSide; ++x) {
        // The angle to the sight is proportional to the distance from the picture's middle.
        const double right = x + 0.5 - kSide / 2.0, up = kSide / 2.0 - y - 0.5, radius = std::hypot(right, up);
        const double angle = radius * view.field_angle / kSide;
        const DVector ray(std::sin(angle) * right / radius, std::sin(angle) * up / radius, -std::cos(angle));
        const double range = 1 / std::max({std::fabs(ray.x), std::fabs(ray.y), std::fabs(ray.z)});
        const auto i = static_cast<std::size_t>(y * kSide + x);
        EXPECT_NEAR(image.depths[i], range, kRounding * range);
        EXPECT_NEAR(image.zs[i], range * std::cos(angle), kRounding * range);
        expect_near(image.positions[i], ray * range, kRounding * range);
        behind += image.zs[i] < 0;
      }
    }
    EXPECT_GT(behind, kSide * 4) << "the rim is there";
  }
}

TEST(Planes, HaveNames) {
  for (const Plane plane : all_planes()) EXPECT_EQ(plane_named(name_of(plane)), plane) << name_of(plane);
  EXPECT_EQ(plane_named("colour"), std::nullopt);
  PlaneSet some{Plane::Z, Plane::Uv};
  some.remove(Plane::Z);
  EXPECT_EQ(some, PlaneSet{Plane::Uv});
  EXPECT_TRUE(some.has_any({Plane::Id, Plane::Uv}));
  EXPECT_FALSE(some.has_any({Plane::Id}));
}

}  // namespace
