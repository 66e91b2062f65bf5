// Pictures through every camera: ways that agree, parts of the whole, places that agree with the published formulas.

#include <facemap/error.h>
#include <facemap/renderer.h>
#include <facemap/turntable.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <cstring>

#include "render/parallel_eye.h"
#include "simd/target.h"
#include "support/lenses.h"
#include "support/scenes.h"

namespace {

using namespace facemap;
using Options = Renderer::Options;

struct Shot {
  std::string name;
  View view;
  int width, height;
};

// A ball over a floor, and a leaf beside it: nothing in it is symmetrical.
Mesh still_life() {
  Mesh mesh = test_scenes::geodesic_sphere(2, {0.1, 0.8, -0.2}, 0.7);
  test_scenes::add_triangle(mesh, {-3, 0, -3}, {-3, 0, 3}, {3, 0, 3});
  test_scenes::add_triangle(mesh, {-3, 0, -3}, {3, 0, 3}, {3, 0, -3});
  test_scenes::add_triangle(mesh, {1, 0.5f, 0.4f}, {1.9f, 0.7f, 0.1f}, {1.2f, 1.6f, -0.6f});
  return mesh;
}

View view_of(const Vector& from) {
  View view;
  view.position = from;
  view.look_at = {0.2f, 0.6f, 0};
  return view;
}

// One of each kind, some from within the scene.
std::vector<Shot> all_shots() {
  std::vector<Shot> shots;
  const auto add = [&](const std::string& name, const Vector& from, const Lens& lens) {
    View view = view_of(from);
    view.lens = lens;
    shots.push_back({name, view, lens.width(), lens.height()});
  };
  add("surface", {1, 2, 3}, Lens::surface(1, 48, 36));
  add("plane", {1, 2, 3}, Lens::plane(1, 48, 36));
  add("equirectangular", {-0.8f, 1.3f, 0.9f}, Lens::equirectangular(64, 32));
  add("cube", {-0.8f, 1.3f, 0.9f}, Lens::cube_map(CubeLayout::Grid3x2, 20));
  add("cube row", {-0.8f, 1.3f, 0.9f}, Lens::cube_map(CubeLayout::Row6x1, 13));
  add("pinhole", {1, 2, 3}, Lens::opencv_pinhole({40, 42, 23, 18}, {-0.2, 0.05, 0.001, -0.002}, 48, 36));
  add("fisheye", {-0.8f, 1.3f, 0.9f}, Lens::opencv_fisheye({12, 12, 22, 20}, {0.02, -0.003}, 45, 41));
  View parallel = view_of({1, 2, 3});
  parallel.is_parallel = true;
  parallel.height = 4;
  shots.push_back({"orthographic", parallel, 48, 36});
  return shots;
}

const std::vector<Light> kLights = {{{2, 4, 1}, {1, 0.9f, 0.8f}, 0.7f}, {{-3, 2, 2}, {0.2f, 0.3f, 1}, 0.5f}};

Options options_of(const Shot& shot) {
  Options options;
  options.width = shot.width;
  options.height = shot.height;
  options.background = {0.1f, 0.2f, 0.3f};
  options.planes = {Plane::Id, Plane::Depth, Plane::Z, Plane::Position, Plane::Normal, Plane::Lights};
  return options;
}

Image picture(const Scene& scene, const Shot& shot, const Options& options) {
  return Renderer(scene, shot.view, kLights, options).render();
}

// NaN equals NaN.
template <class Value>
bool same_bytes(const std::vector<Value>& a, const std::vector<Value>& b) {
  return a.size() == b.size() && (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(Value)) == 0);
}

void expect_same(const Image& is, const Image& should, const std::string& what) {
  ASSERT_EQ(is.width, should.width) << what;
  ASSERT_EQ(is.height, should.height) << what;
  EXPECT_TRUE(same_bytes(is.pixels, should.pixels)) << what << ": colours";
  EXPECT_TRUE(same_bytes(is.ids, should.ids)) << what << ": ids";
  EXPECT_TRUE(same_bytes(is.depths, should.depths)) << what << ": depths";
  EXPECT_TRUE(same_bytes(is.zs, should.zs)) << what << ": z";
  EXPECT_TRUE(same_bytes(is.positions, should.positions)) << what << ": positions";
  EXPECT_TRUE(same_bytes(is.normals, should.normals)) << what << ": normals";
  EXPECT_TRUE(same_bytes(is.lights, should.lights)) << what << ": lights";
}

template <class Value>
std::vector<Value> part_of(const std::vector<Value>& plane, const Image& image, const PixelBox& box, std::size_t size) {
  std::vector<Value> part;
  for (int y = box.y; y < box.y + box.height; ++y) {
    const auto first = plane.begin() + static_cast<std::ptrdiff_t>(size) * (y * image.width + box.x);
    part.insert(part.end(), first, first + static_cast<std::ptrdiff_t>(size) * box.width);
  }
  return part;
}

Image part_of(const Image& image, const PixelBox& box) {
  Image part;
  part.width = box.width;
  part.height = box.height;
  part.light_count = image.light_count;
  part.pixels = part_of(image.pixels, image, box, 1);
  part.ids = part_of(image.ids, image, box, 1);
  part.depths = part_of(image.depths, image, box, 1);
  part.zs = part_of(image.zs, image, box, 1);
  part.positions = part_of(image.positions, image, box, 1);
  part.normals = part_of(image.normals, image, box, 1);
  part.lights = part_of(image.lights, image, box, static_cast<std::size_t>(image.light_bytes()));
  return part;
}

class Targets {
 public:
  ~Targets() { simd::set_active_target(before_); }

 private:
  simd::Target before_ = simd::active_target();
};

TEST(Cameras, AllWaysToMakeAPictureAgree) {
  const Targets restored;
  const Scene scene(still_life());
  for (const Shot& shot : all_shots()) {
    Options options = options_of(shot);
    options.samples = 2;
    options.threads = 1;
    options.strategy = Renderer::Strategy::Lists;
    const Image should = picture(scene, shot, options);
    std::size_t seen = 0;
    for (const FaceId id : should.ids) seen += id != kNoFace;
    EXPECT_GT(seen, should.ids.size() / 10) << shot.name;
    options.strategy = Renderer::Strategy::Transposed;
    for (const simd::Target target : simd::supported_targets()) {
      simd::set_active_target(target);
      for (const int threads : {1, 3}) {
        options.threads = threads;
        expect_same(picture(scene, shot, options), should, shot.name + ", " + simd::name_of(target));
      }
    }
  }
}

// A sample a pixel, each asked by itself of a map of faces.
TEST(Cameras, RaysAskedOneByOneSeeTheSame) {
  const Scene scene(still_life());
  for (const Shot& shot : all_shots()) {
    Options options = options_of(shot);
    const Image should = picture(scene, shot, options);
    options.sampling = Renderer::Sampling::Edges;
    expect_same(picture(scene, shot, options), should, shot.name);
  }
}

TEST(Cameras, ACropIsThatPartOfThePicture) {
  const Scene scene(still_life());
  Random random(20260100);
  for (const Shot& shot : all_shots()) {
    for (const auto strategy : {Renderer::Strategy::Lists, Renderer::Strategy::Transposed}) {
      for (const auto sampling : {Renderer::Sampling::Grid, Renderer::Sampling::Edges}) {
        Options options = options_of(shot);
        options.strategy = strategy;
        options.sampling = sampling;
        options.samples = random.between(1, 3);
        const Image whole = picture(scene, shot, options);
        const int x = random.below(shot.width), y = random.below(shot.height);
        const PixelBox box = {x, y, random.between(1, shot.width - x), random.between(1, shot.height - y)};
        options.crop = box;
        expect_same(picture(scene, shot, options), part_of(whole, box),
                    shot.name + " from " + std::to_string(x) + ", " + std::to_string(y));
      }
    }
  }
}

TEST(Cameras, CropsBeyondThePictureAreRefused) {
  const Scene scene(still_life());
  const Shot shot = all_shots()[0];
  Options options = options_of(shot);
  for (const PixelBox& box : {PixelBox{-1, 0, 4, 4}, PixelBox{0, 0, 0, 4}, PixelBox{0, 0, 4, 0},
                              PixelBox{shot.width - 3, 0, 4, 4}, PixelBox{0, 0, 4, shot.height + 1}}) {
    options.crop = box;
    EXPECT_THROW(picture(scene, shot, options), Error);
  }
}

TEST(Cameras, ALensOfAnotherSizeIsRefused) {
  const Scene scene(still_life());
  Shot shot = all_shots()[2];
  Options options = options_of(shot);
  ++options.width;
  EXPECT_THROW(picture(scene, shot, options), Error);
  shot.view.lens = std::nullopt;
  shot.view.is_parallel = true;
  for (const double height : {0.0, -1.0, std::nan("")}) {
    shot.view.height = height;
    EXPECT_THROW(picture(scene, shot, options), Error);
  }
}

// u, v of OpenCV's documentation, for a point of the camera's axes: x to the right, y down, z ahead.
std::pair<long double, long double> published_fisheye(const CameraMatrix& K, const FisheyeDistortion& D, long double x,
                                                      long double y, long double z) {
  const long double r = std::sqrt(x * x + y * y), theta = std::atan2(r, z), s = theta * theta;
  const long double bent = theta * (1 + s * (D.k1 + s * (D.k2 + s * (D.k3 + s * D.k4))));
  return {K.fx * bent * x / r + K.cx, K.fy * bent * y / r + K.cy};
}

// Each pixel's point, as the picture's plane of positions has it, is where the published formula projects to the
// pixel's centre. Positions are float32 of at most 8 units, so off by 2^-22 in each coordinate, 1.7 times that in all,
// from no nearer than 0.5 units; at 290 pixels a radian that is 2.4e-4 pixels; most are nearer the middle.
TEST(Cameras, OpenCVFisheyeProjectsAsPublished) {
  constexpr double kTolerance = 1e-4;  // pixels
  const CameraMatrix K = {290, 291, 508.2, 513.7};
  const FisheyeDistortion D = {-0.012, 0.004, -0.0035, 0.0006};
  const Scene scene(test_scenes::geodesic_sphere(3, {0, 0, 0}, 2));  // seen from within, all around
  View view;
  view.position = {0.25f, -0.125f, 0.5f};
  view.look_at = {1.25f, 0.375f, 2.5f};
  view.lens = Lens::opencv_fisheye(K, D, 1024, 1024);
  Options options;
  options.width = options.height = 1024;
  options.planes = {Plane::Position};
  const Image image = Renderer(scene, view, {}, options).render();
  const SpaceVector frame = SpaceVector::looking_at(view.position, view.look_at, view.up);
  Random random(20260101);
  int asked = 0;
  double worst = 0;
  while (asked < 10'000) {
    const int column = random.below(1024), row = random.below(1024);
    const Vector& at = image.positions[static_cast<std::size_t>(row * 1024 + column)];
    if (std::isnan(at.x)) continue;
    ++asked;
    const DVector p = frame.local_from_world(DVector(at) - DVector(view.position));
    const auto [u, v] = published_fisheye(K, D, p.x, -p.y, p.z);
    worst = std::max({worst, std::fabs(static_cast<double>(u) - column), std::fabs(static_cast<double>(v) - row)});
  }
  std::printf("10000 points are at most %.2g pixels off\n", worst);
  EXPECT_LT(worst, kTolerance);
}

// A wall three units to the right and a little behind, seen by a fisheye of 220 degrees: at the rim range and z are
// those of the geometry.
TEST(Cameras, DepthsAtTheRimOfAWideFisheyeAgreeWithGeometry) {
  constexpr double kRounding = 0x1p-20;  // of float32 directions and depths, relative
  Mesh mesh;
  test_scenes::add_triangle(mesh, {3, -100, -100}, {3, 100, -100}, {3, 0, 200});
  const Scene scene(mesh);
  View view;
  view.look_at = {0, 0, -1};
  const double rim = 110 * M_PI / 180, f = 512 / rim;
  view.lens = Lens::opencv_fisheye({f, f, 511.5, 511.5}, {}, 1024, 1024);
  Options options;
  options.width = options.height = 1024;
  options.planes = {Plane::Depth, Plane::Z};
  const Image image = Renderer(scene, view, {}, options).render();
  int behind = 0;
  for (int column = 600; column < 1024; column += 4) {
    for (int row = 400; row < 624; row += 8) {
      const double x = (column + 0.5 - 512) / f, y = (512 - row - 0.5) / f, angle = std::sqrt(x * x + y * y);
      if (angle > rim) continue;
      const double right = std::sin(angle) * x / angle, range = 3 / right, z = range * std::cos(angle);
      const auto pixel = static_cast<std::size_t>(row * 1024 + column);
      ASSERT_NEAR(image.depths[pixel], range, 4 * kRounding * range);
      ASSERT_NEAR(image.zs[pixel], z, 4 * kRounding * range);
      behind += z < 0;
    }
  }
  EXPECT_GT(behind, 500);
}

// One small face in each of six directions from the camera, which looks along +x with +y up: right of it is +z.
TEST(Cameras, PanoramasAreNotMirrored) {
  const DVector directions[] = {{0, 0, 1}, {0, 0, -1}, {0, 1, 0}, {0, -1, 0}, {1, 0, 0}, {-1, 0, 0}};
  Mesh mesh;
  for (const DVector& d : directions) {
    const Vector middle(d * 4.0), side(d.y, d.z, d.x), other(d.z, d.x, d.y);
    test_scenes::add_triangle(mesh, middle + side, middle - side + other, middle - side - other);
  }
  const Scene scene(mesh);
  View view;
  view.look_at = {1, 0, 0};
  const auto ids_of = [&](const Lens& lens) {
    view.lens = lens;
    Options options;
    options.width = lens.width();
    options.height = lens.height();
    options.planes = {Plane::Id};
    return Renderer(scene, view, {}, options).render().ids;
  };
  const std::vector<FaceId> panorama = ids_of(Lens::equirectangular(64, 32));
  const auto at = [](const std::vector<FaceId>& ids, int width, int x, int y) {
    return ids[static_cast<std::size_t>(y * width + x)];
  };
  EXPECT_EQ(at(panorama, 64, 32, 16), 4);  // ahead
  EXPECT_EQ(at(panorama, 64, 48, 16), 0);  // right
  EXPECT_EQ(at(panorama, 64, 16, 16), 1);  // left
  EXPECT_EQ(at(panorama, 64, 0, 16), 5);   // behind
  EXPECT_EQ(at(panorama, 64, 63, 16), 5);
  EXPECT_EQ(at(panorama, 64, 10, 0), 2);   // above
  EXPECT_EQ(at(panorama, 64, 10, 31), 3);  // below
  const std::vector<FaceId> cube = ids_of(Lens::cube_map(CubeLayout::Row6x1, 9));
  for (int face = 0; face < 6; ++face) EXPECT_EQ(at(cube, 54, 9 * face + 4, 4), face);
}

// Within a ball the points at both sides of each join of the four faces around are near each other.
TEST(Cameras, FacesOfACubeMapJoin) {
  constexpr int kSide = 64;
  const Scene scene(test_scenes::geodesic_sphere(4, {0, 0, 0}, 1));
  View view;
  view.position = {0.1f, 0.2f, -0.1f};
  view.look_at = {0.5f, 0.3f, 0.9f};
  view.lens = Lens::cube_map(CubeLayout::Row6x1, kSide);
  Options options;
  options.width = 6 * kSide;
  options.height = kSide;
  options.planes = {Plane::Position};
  const Image image = Renderer(scene, view, {}, options).render();
  const auto at = [&](int face, int x, int y) {
    return DVector(image.positions[static_cast<std::size_t>(y * image.width + face * kSide + x)]);
  };
  // Two pixels' width of 90 degrees, at the ball's far side at most 1.3 away.
  const double largest = 2 * (2.0 / kSide) * 1.3;
  const int around[] = {4, 0, 5, 1, 4};  // ahead, right, behind, left
  for (int k = 0; k < 4; ++k) {
    for (int y = 0; y < kSide; ++y) {
      const DVector gap = at(around[k], kSide - 1, y) - at(around[k + 1], 0, y);
      ASSERT_LT(std::sqrt(gap.x * gap.x + gap.y * gap.y + gap.z * gap.z), largest) << "join " << k << ", row " << y;
    }
  }
  for (int x = 0; x < kSide; ++x) {
    for (const DVector& gap : {at(2, x, kSide - 1) - at(4, x, 0), at(4, x, kSide - 1) - at(3, x, 0)}) {
      ASSERT_LT(std::sqrt(gap.x * gap.x + gap.y * gap.y + gap.z * gap.z), largest) << "column " << x;
    }
  }
}

TEST(Orthographic, RaysBeginInFrontOfTheSceneWhereverTheCameraStands) {
  Random random(20260102);
  for (int i = 0; i < 100; ++i) {
    const test_scenes::TestScene made = test_scenes::make_any_scene(random, 60);
    const Scene scene(made.mesh);
    View view;
    view.position = test_scenes::make_origin(made, random);
    view.look_at = Vector(DVector(view.position) + random.direction() * (scene.bounding_radius() + 1e-3));
    if (view.look_at == view.position) continue;
    view.up = Vector(random.direction());
    view.is_parallel = true;
    view.height = 2 * scene.bounding_radius() + 1e-3;
    Options options;
    options.width = options.height = 16;
    const ParallelEye eye(scene, view, options);
    for (const MapPoint& place : {MapPoint(0.5, 0.5), MapPoint(8, 8), MapPoint(15.5, 3.5)}) {
      const Eye::Ray ray = eye.ray(place);
      for (const Vector& p : scene.mesh().positions) {
        const DVector offset = DVector(p) - DVector(ray.origin), d(ray.direction);
        ASSERT_GT(offset.x * d.x + offset.y * d.y + offset.z * d.z, 0) << made.name;
      }
    }
  }
}

// From 6.8 million units away, where float32 steps are half a unit, a picture is that from nearby: places are still
// found in double precision.
TEST(Orthographic, AFarCameraSeesWhatANearOneSees) {
  const Scene scene(still_life());
  View view;
  view.is_parallel = true;
  view.height = 5;
  view.position = {2, 3, 6};
  view.look_at = {0, 1, 0};
  Options options;
  options.width = options.height = 200;
  options.planes = {Plane::Id, Plane::Depth};
  const Image near = Renderer(scene, view, {}, options).render();
  view.position = Vector(2, 2, 6) * 0x1p20f + Vector(0, 1, 0);
  const Image far = Renderer(scene, view, {}, options).render();
  std::size_t different = 0;
  for (std::size_t i = 0; i < near.ids.size(); ++i) different += near.ids[i] != far.ids[i];
  EXPECT_LT(different, near.ids.size() / 1000);  // edges that pass through pixels' centres but for rounding
  const float way = std::sqrt(44.0f) * 0x1p20f;
  for (const float depth : far.depths) {
    if (!std::isinf(depth)) {
      ASSERT_NEAR(depth, way, 8);
    }
  }
}

// A pixel is height / rows world units; depths are from the camera's plane, also behind it.
TEST(Orthographic, PlacesAndDepthsAreThoseOfTheCameraPlane) {
  Mesh mesh;
  test_scenes::add_triangle(mesh, {0.5f, 0.5f, -2}, {1.5f, 0.5f, -2}, {0.5f, 1.5f, -2});
  test_scenes::add_triangle(mesh, {-1.5f, -1.5f, 3}, {-0.5f, -1.5f, 3}, {-1.5f, -0.5f, 3});
  const Scene scene(mesh);
  View view;  // at 0, along -z
  view.is_parallel = true;
  view.height = 4;
  Options options;
  options.width = 60;
  options.height = 40;
  options.planes = {Plane::Id, Plane::Depth, Plane::Z, Plane::Position, Plane::FaceNormal};
  const Image image = Renderer(scene, view, {}, options).render();
  int seen[2] = {0, 0};
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 60; ++column) {
      const auto pixel = static_cast<std::size_t>(row * 60 + column);
      const double x = (column + 0.5 - 30) * 0.1, y = (20 - row - 0.5) * 0.1;
      if (std::fabs(std::fabs(x + y) - 2) < 1e-9) continue;  // on an edge, up to rounding
      const FaceId should = x > 0.5 && y > 0.5 && x + y < 2 ? 0 : x > -1.5 && y > -1.5 && x + y < -2 ? 1 : kNoFace;
      ASSERT_EQ(image.ids[pixel], should) << column << " " << row;
      if (should == kNoFace) continue;
      ++seen[should];
      ASSERT_NEAR(image.depths[pixel], should == 0 ? 2 : -3, 1e-6);
      ASSERT_EQ(image.zs[pixel], image.depths[pixel]);
      ASSERT_NEAR(image.positions[pixel].x, x, 1e-6);
      ASSERT_NEAR(image.positions[pixel].y, y, 1e-6);
      ASSERT_EQ(image.face_normals[pixel], Vector(0, 0, 1));
    }
  }
  EXPECT_GT(seen[0], 30);
  EXPECT_GT(seen[1], 30);
}

TEST(Cameras, AMadeUpViewHoldsTheScene) {
  const Scene scene(still_life());
  for (const Shot& shot : all_shots()) {
    Options options = options_of(shot);
    View view = make_up_view(scene, shot.view);
    if (view.is_parallel) {
      EXPECT_EQ(view.height, 2 * scene.bounding_radius());
    }
    const std::vector<View> views = turntable(view, 3);
    for (const View& one : views) {
      EXPECT_EQ(one.is_parallel, view.is_parallel);
      EXPECT_EQ(one.lens.has_value(), view.lens.has_value());
      const Image image = Renderer(scene, one, {}, options).render();
      std::size_t seen = 0;
      for (const FaceId id : image.ids) seen += id != kNoFace;
      EXPECT_GT(seen, image.ids.size() / 100) << shot.name;
      if (view.lens && view.lens->piece_width() < view.lens->width()) continue;  // no picture has a border
      if (view.lens && view.lens->kind() == LensKind::Equirectangular) continue;
      for (int x = 0; x < image.width; ++x) {
        EXPECT_EQ(image.ids[static_cast<std::size_t>(x)], kNoFace) << shot.name << ", top row";
        EXPECT_EQ(image.ids[image.ids.size() - 1 - static_cast<std::size_t>(x)], kNoFace) << shot.name << ", last row";
      }
    }
  }
}

}  // namespace
