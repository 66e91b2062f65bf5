// Whole pictures: random pixels and pixels at edges against the referee; and where a general ray tracer sees
// another picture, the referee must side with ours. FACEMAP_PICTURES=all takes every scene in full (scripts/verify).

#include <facemap/camera.h>
#include <facemap/generators.h>
#include <facemap/renderer.h>
#include <facemap/scene.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <glm/geometric.hpp>
#include <ostream>
#include <string>
#include <utility>
#include <vector>

#include "support/oracle.h"
#include "support/random.h"
#ifdef FACEMAP_HAVE_EMBREE
#include "support/embree_referee.h"
#endif

namespace {

using namespace facemap;

struct Sizes {
  int side;    // pixels
  int random;  // pixels asked
  int edge;
};
constexpr Sizes kFull{1024, 2000, 2000}, kSample{96, 20, 20};

struct Shot {
  std::string name;
  Scene scene;
  View view;
  std::vector<Light> lights;
};

Shot generated(const std::string& name) {
  const GeneratedScene made = generate_scene(name);
  Shot shot{name, Scene(made.mesh), {}, {}};
  shot.view = {made.camera_position, made.look_at, made.up, made.field_angle_deg * M_PI / 180, ProjectionKind::Plane};
  for (const auto& light : made.lights) shot.lights.push_back({light.position, Color{1, 1, 1}, light.intensity});
  return shot;
}

std::filesystem::path models() {
  const char* folder = std::getenv("FACEMAP_MODELS");
  return folder != nullptr ? folder : std::filesystem::path(FACEMAP_SOURCE_DIR) / ".." / "shared" / "models";
}

Shot from_file(const std::string& path, bool from_inside) {
  Scene scene = Scene::load(models() / path);
  Shot shot{path, scene, make_up_view(scene), make_up_lights(scene)};
  if (!from_inside) return shot;
  const DVector size = DVector(scene.upper()) - DVector(scene.lower()), centre = scene.centre();
  shot.view.position = Vector(centre + size * DVector(0.1, 0.05, 0.15));
  shot.view.look_at = Vector(centre - size * DVector(0.3, 0.2, 0.25));
  shot.view.field_angle = M_PI;  // a fisheye
  shot.lights[0].position = Vector(centre + size * DVector(-0.1, 0.2, 0.05));
  return shot;
}

class Picture {
 public:
  Picture(const Shot& shot, int side)
      : shot_(shot),
        oracle_(shot.scene.mesh()),
        view_(oracle_.from(shot.view.position)),
        camera_(make_camera(shot, side)),
        image_(render(shot, side)) {
    for (const Light& light : shot.lights) lights_.push_back(oracle_.from(light.position));
  }

  struct Tally {
    int pixels = 0, lit_or_dark = 0, wrong = 0;
  };

  // Why a picture differs from ours in a pixel, seen exactly.
  enum Reason {
    kLightsAlone,  // the same face, other lights
    kDuplicate,    // its face is a duplicate, which we leave out
    kCoincident,   // its face is met as well, behind ours by less than a rounding of float32
    kNotMet,       // its face is not met by the ray, or nothing is where it sees a face
    kMissed,       // it sees nothing where the ray meets our face
    kFarther,      // its face is farther by more than that
    kReasonCount,
  };

  Tally check(int random_pixels, int edge_pixels) {
    Random random(0x5eed0050);
    Tally tally;
    for (int i = 0; i < random_pixels; ++i) {
      const int x = random.below(image_.width), y = random.below(image_.height);
      check(x, y, tally);
    }
    std::vector<int> edges;
    for (int i = 0; i < image_.width * image_.height; ++i) {
      if (is_edge(i % image_.width, i / image_.width)) edges.push_back(i);
    }
    for (int i = 0; i < edge_pixels && !edges.empty(); ++i) {
      const int pixel = edges[random.below(static_cast<int>(edges.size()))];
      check(pixel % image_.width, pixel / image_.width, tally);
    }
    return tally;
  }

  // Every pixel in which `seen` (a face and a mask of lights) differs from ours is written to `list` and checked.
  struct Other {
    FaceId face;
    std::vector<bool> lit;
  };
  Tally check_differences(const std::function<Other(const Vector& direction)>& look, std::ostream& list,
                          std::array<int, kReasonCount>& reasons) {
    Tally tally;
    reasons.fill(0);
    for (int y = 0; y < image_.height; ++y) {
      for (int x = 0; x < image_.width; ++x) {
        const Other other = look(direction(x, y));
        const std::string ours = text(image_.ids[index(x, y)], lit(x, y)), theirs = text(other.face, other.lit);
        if (ours == theirs) continue;
        const int wrong_before = tally.wrong;
        check(x, y, tally);
        ++reasons[reason(direction(x, y), image_.ids[index(x, y)], other.face)];
        list << x << ' ' << y << " ours " << ours << " theirs " << theirs
             << (tally.wrong == wrong_before ? " exact: ours" : " exact: NOT OURS") << '\n';
      }
    }
    return tally;
  }

 private:
  static Camera make_camera(const Shot& shot, int side) {
    Camera::Options options;
    options.projection = shot.view.projection;
    options.field_angle = shot.view.field_angle;
    options.width = options.height = side;
    return Camera(shot.scene, SpaceVector::looking_at(shot.view.position, shot.view.look_at, shot.view.up), options);
  }

  static Image render(const Shot& shot, int side) {
    Renderer::Options options;
    options.width = options.height = side;
    options.normals = Renderer::Normals::Flat;  // smooth ones move the points that are asked
    options.planes = {Plane::Id, Plane::Depth, Plane::Lights};
    return Renderer(shot.scene, shot.view, shot.lights, options).render();
  }

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * image_.width + x; }
  Vector direction(int x, int y) const { return camera_.direction_through({x + 0.5, y + 0.5}); }

  std::vector<bool> lit(int x, int y) const {
    std::vector<bool> result;
    for (std::size_t k = 0; k < shot_.lights.size(); ++k) {
      result.push_back(image_.lights[index(x, y) * image_.light_bytes() + k / 8] >> (k % 8) & 1);
    }
    return result;
  }

  Reason reason(const Vector& d, FaceId ours, FaceId theirs) const {
    if (ours == theirs) return kLightsAlone;
    if (theirs == kNoFace) return kMissed;
    if (!oracle_.is_kept(theirs)) return kDuplicate;
    if (ours == kNoFace || !view_.meets(theirs, d)) return kNotMet;
    return view_.distance(theirs, d) <= view_.distance(ours, d) * (1 + 0x1p-20) ? kCoincident : kFarther;
  }

  bool is_edge(int x, int y) const {
    for (const auto& [u, v] : {std::pair{x + 1, y}, {x, y + 1}}) {
      if (u >= image_.width || v >= image_.height) continue;
      if (image_.ids[index(u, v)] != image_.ids[index(x, y)] || lit(u, v) != lit(x, y)) return true;
    }
    return false;
  }

  static std::string text(FaceId face, const std::vector<bool>& lit) {
    std::string result = std::to_string(face) + " ";
    for (const bool bit : lit) result += face == kNoFace ? '-' : bit ? '1' : '0';
    return result;
  }

  void check(int x, int y, Tally& tally) {
    ++tally.pixels;
    const Vector d = direction(x, y);
    const oracle::Hit truth = view_.nearest(d);
    Other exact{truth.face, std::vector<bool>(lights_.size(), false)};
    if (truth.face != kNoFace) {
      const Mesh& mesh = shot_.scene.mesh();
      const SurfacePoint point{shot_.view.position,
                               d,
                               {mesh.vertex(truth.face, 0), mesh.vertex(truth.face, 1), mesh.vertex(truth.face, 2)},
                               truth.face,
                               truth.side};
      for (std::size_t k = 0; k < lights_.size(); ++k) exact.lit[k] = lights_[k].is_lit(point);
      tally.lit_or_dark += static_cast<int>(lights_.size());
    }
    const FaceId ours = image_.ids[index(x, y)];
    const std::string expected = text(exact.face, exact.lit), actual = text(ours, lit(x, y));
    if (expected == actual) return;
    ++tally.wrong;
    ADD_FAILURE() << shot_.name << " pixel " << x << ' ' << y << ": " << actual << ", the oracle " << expected;
  }

  const Shot& shot_;
  oracle::Oracle oracle_;
  oracle::View view_;
  std::vector<oracle::View> lights_;
  Camera camera_;
  Image image_;
};

#ifdef FACEMAP_HAVE_EMBREE
void compare_with_embree(const Shot& shot, Picture& picture) {
  const EmbreeReferee embree(shot.scene.mesh(), true);
  const auto look = [&](const Vector& d) {
    const Vector K = shot.view.position;
    const EmbreeReferee::Hit hit = d == Vector(0) ? EmbreeReferee::Hit() : embree.nearest(K, d);
    Picture::Other other{hit.face, std::vector<bool>(shot.lights.size(), false)};
    if (hit.face == kNoFace) return other;
    const Vector P = K + hit.t * d;
    for (std::size_t k = 0; k < shot.lights.size(); ++k) {
      const Vector L = shot.lights[k].position;
      const bool is_facing = glm::dot(hit.normal, K - P) * glm::dot(hit.normal, L - P) > 0;
      other.lit[k] = is_facing && !embree.is_blocked(L, P);
    }
    return other;
  };
  std::string stem = shot.name;
  for (char& c : stem) c = c == '/' || c == '.' ? '-' : c;
  const auto path = std::filesystem::temp_directory_path() / ("facemap-beside-embree-" + stem + ".txt");
  std::ofstream list(path);
  std::array<int, Picture::kReasonCount> reasons;
  const Picture::Tally tally = picture.check_differences(look, list, reasons);
  std::printf("%-44s %d pixels differ from Embree's, unexplained: %d\n", shot.name.c_str(), tally.pixels, tally.wrong);
  std::printf(
      "%44s %d in lights alone, %d duplicates that we leave out, %d faces behind ours by less than a rounding, "
      "%d faces that the ray does not meet, %d misses, %d other; listed in %s\n",
      "", reasons[Picture::kLightsAlone], reasons[Picture::kDuplicate], reasons[Picture::kCoincident],
      reasons[Picture::kNotMet], reasons[Picture::kMissed], reasons[Picture::kFarther], path.c_str());
  EXPECT_EQ(tally.wrong, 0);
}
#endif

bool wants_all() {
  const char* which = std::getenv("FACEMAP_PICTURES");
  return which != nullptr && std::string(which) == "all";
}

void check(const Shot& shot, const Sizes& sizes) {
  Picture picture(shot, sizes.side);
  const Picture::Tally tally = picture.check(sizes.random, sizes.edge);
  std::printf("%-44s %zu faces: %d pixels and %d shadow questions equal the oracle's, differences: %d\n",
              shot.name.c_str(), shot.scene.face_count(), tally.pixels - tally.wrong, tally.lit_or_dark, tally.wrong);
  std::fflush(stdout);
  EXPECT_EQ(tally.wrong, 0);
#ifdef FACEMAP_HAVE_EMBREE
  if (sizes.side == kFull.side) compare_with_embree(shot, picture);
#endif
}

class GeneratedPictures : public testing::TestWithParam<std::string> {};

TEST_P(GeneratedPictures, PixelsEqualTheOracle) {
  if (!wants_all() && GetParam() != "bust" && GetParam() != "chessboard") return;
  check(generated(GetParam()), wants_all() ? kFull : kSample);
}

std::string parameter_of(const testing::TestParamInfo<std::string>& test) { return test.param; }

INSTANTIATE_TEST_SUITE_P(Scenes, GeneratedPictures, testing::ValuesIn(generator_names()), parameter_of);

class ModelPictures : public testing::TestWithParam<const char*> {};

TEST_P(ModelPictures, PixelsEqualTheOracle) {
  const std::string path = GetParam();
  if (!std::filesystem::exists(models() / path)) {
    std::printf("skipped: %s is not there\n", (models() / path).c_str());
    return;
  }
  if (!wants_all()) {
    std::printf("skipped: FACEMAP_PICTURES is not 'all'\n");
    return;
  }
  check(from_file(path, path.find("room") != std::string::npos), kFull);
}

INSTANTIATE_TEST_SUITE_P(Models, ModelPictures,
                         testing::Values("scenes/chessboard/chessboard.obj", "scenes/nefertiti/nefertiti-lowres.obj",
                                         "scenes/copperBeech/copperBeech.obj", "scenes/hotel_room/hotel_room.obj",
                                         "scenes/typewriter_1930s/typewriter_1930s.obj",
                                         "scenes/coconutTree/coconutTree.obj",
                                         "scenes/chandelier-lamp/chandelier-lamp.obj",
                                         "scenes/spider_plant/spider_plant.obj", "classic/armadillo/armadillo.obj",
                                         "classic/bunny/stanford-bunny.obj"));

}  // namespace
