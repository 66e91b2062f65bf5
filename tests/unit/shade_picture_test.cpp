#include "render/shade_picture.h"

#include <facemap/camera.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <memory>

#include "map/face_planes.h"
#include "map/light_lists.h"
#include "material/material_table.h"
#include "math/dvector.h"
#include "picture/moved_points.h"
#include "render/light_sources.h"
#include "render/shade.h"
#include "simd/target.h"
#include "support/scenes.h"

using namespace facemap;
using namespace test_scenes;

namespace {

// Normals at the corners: near the face's own, as of a smooth surface, now and then any, zero or none.
void add_normals(Mesh& mesh, Random& random) {
  const double roughness = random.between(0.0, 0.6);
  for (const Corners& corners : mesh.triangles) {
    const DVector a(mesh.positions[corners[0]]), b(mesh.positions[corners[1]]), c(mesh.positions[corners[2]]);
    const DVector n = normalized(cross(b - a, c - a));
    const double turn = random.chance(0.5) ? 1 : -1;
    Corners normal_corners;
    for (std::uint32_t& corner : normal_corners) {
      corner = static_cast<std::uint32_t>(mesh.normals.size());
      DVector normal = n * turn + random.in_cube() * roughness;
      if (random.chance(0.05)) normal = random.in_cube();
      if (random.chance(0.02)) normal = DVector(0);
      mesh.normals.push_back(Vector(normal));
      if (random.chance(0.02)) corner = kNoIndex;
    }
    mesh.normal_corners.push_back(normal_corners);
  }
}

// A picture of a few texels of any colour.
TextureImage make_image(Random& random) {
  Image image;
  image.width = random.between(1, 9);
  image.height = random.between(1, 9);
  for (int i = 0; i < image.width * image.height; ++i) {
    image.pixels.push_back(Color::from_24_bit(static_cast<std::uint32_t>(random.next() & 0xffffff)));
  }
  return {"image", {}, encode_png(image)};
}

TextureUse make_use(Random& random, double chance) {
  TextureUse use;
  if (!random.chance(chance)) return use;
  use.image = static_cast<std::uint32_t>(random.below(3));
  use.is_v_down = random.chance(0.5);
  use.wrap_u = static_cast<TextureUse::Wrap>(random.below(3));
  use.wrap_v = static_cast<TextureUse::Wrap>(random.below(3));
  use.scale = {static_cast<float>(random.between(-3.0, 3.0)), 1};
  use.rotation = static_cast<float>(random.between(0.0, 6.0));
  use.channel = random.between(-1, 3);
  use.is_smooth = random.chance(0.7);
  return use;
}

Vector make_colour(Random& random) { return Vector(DVector(random.unit(), random.unit(), random.unit())); }

Material make_material(Random& random) {
  Material material;
  material.kind = random.chance(0.5) ? Material::Kind::Phong : Material::Kind::MetalRough;
  material.diffuse = make_colour(random);
  material.specular = make_colour(random);
  if (random.chance(0.2)) material.emission = make_colour(random);
  material.shininess = static_cast<float>(random.between(0.0, 60.0));
  material.metallic = static_cast<float>(random.unit());
  material.roughness = static_cast<float>(random.unit());
  material.is_unlit = random.chance(0.1);
  material.illumination = random.between(1, 2);
  material.diffuse_map = make_use(random, 0.5);
  for (TextureUse* use : {&material.specular_map, &material.shininess_map, &material.emission_map,
                          &material.metallic_map, &material.roughness_map, &material.normal_map, &material.bump_map}) {
    *use = make_use(random, 0.2);
  }
  return material;
}

// Materials on most faces, texture coordinates on most corners, colours on some meshes' vertices.
Model with_materials(const Mesh& mesh, Random& random) {
  Model model;
  model.mesh = mesh;
  for (int i = 0; i < 3; ++i) model.images.push_back(make_image(random));
  for (int i = 0; i < 5; ++i) model.materials.push_back(make_material(random));
  for (std::size_t face = 0; face < mesh.face_count(); ++face) {
    model.mesh.triangle_materials.push_back(random.chance(0.1) ? kNoIndex
                                                               : static_cast<std::uint32_t>(random.below(5)));
    Corners corners;
    for (std::uint32_t& corner : corners) {
      corner = static_cast<std::uint32_t>(model.mesh.texture_coordinates.size());
      model.mesh.texture_coordinates.push_back(
          {static_cast<float>(random.between(-2.0, 2.0)), static_cast<float>(random.between(-2.0, 2.0))});
      if (random.chance(0.02)) corner = kNoIndex;
    }
    model.mesh.texture_corners.push_back(corners);
  }
  if (random.chance(0.3)) {
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) model.mesh.colours.push_back(make_colour(random));
  }
  return model;
}

Color make_light_colour(Random& random) {
  const Vector colour = make_colour(random);
  return {colour.x, colour.y, colour.z};
}

struct Setting {
  Scene scene;
  SampleGrid grid;
  std::vector<Light> lights;
  Renderer::Options options;
};

Setting make_setting(Random& random, bool has_materials) {
  TestScene made = make_any_scene(random, 60);
  if (random.chance(0.8)) add_normals(made.mesh, random);
  const Vector camera = make_origin(made, random);
  DVector sight = DVector(made.centre) - DVector(camera);
  if (sight == DVector(0)) sight = DVector(0, 0, -1);
  const bool plane = random.chance(0.5);
  const Projection projection(plane ? ProjectionKind::Plane : ProjectionKind::Surface,
                              random.between(0.2, plane ? 2.5 : 6.28), random.between(1, 40), random.between(1, 40));
  Scene scene = has_materials ? Scene(with_materials(made.mesh, random)) : Scene(made.mesh);
  Setting setting{std::move(scene), {SpaceVector::looking_along(camera, sight), projection, 1}, {}, {}};
  if (has_materials) setting.grid.per_side = random.between(1, 2);
  setting.lights.resize(static_cast<std::size_t>(random.between(1, 20)));
  for (Light& light : setting.lights) {
    light.position = make_origin(made, random);
    light.color = {static_cast<float>(random.unit()), static_cast<float>(random.unit()), 1};
    light.intensity = static_cast<float>(random.between(0.0, 3.0));
    if (random.chance(0.5)) test_scenes::make_any_kind(made, random, light);
  }
  setting.options.normals = random.chance(0.7) ? Renderer::Normals::Smooth : Renderer::Normals::Flat;
  setting.options.shadow_terminator_fix = random.chance(0.8);
  setting.options.falloff = random.chance(0.5) ? Renderer::Falloff::Constant : Renderer::Falloff::InverseSquare;
  if (random.chance(0.4)) {
    setting.options.ambient = make_light_colour(random);
    setting.options.sky_up = make_light_colour(random);
    setting.options.up = Vector(random.direction());
  }
  if (random.chance(0.5)) setting.options.planes.add(Plane::Lights);  // else lights that add nothing are not asked
  return setting;
}

// What Shader says of every sample.
struct Expected {
  NearestFaces nearest;
  std::vector<Sample> samples;
  ListsOfLights lights;
};

Expected shade_singly(const Setting& setting, const MaterialTable* materials = nullptr) {
  Expected expected;
  for (const Light& light : setting.lights) {
    expected.lights.push_back(std::make_unique<LightLists>(setting.scene, light, PointLight::Options()));
  }
  Camera::Options options;
  options.projection = setting.grid.lens.projection()->kind();
  options.field_angle = setting.grid.lens.projection()->field_angle();
  options.width = setting.grid.lens.projection()->width();
  options.height = setting.grid.lens.projection()->height();
  const Camera camera(setting.scene, setting.grid.frame, options);
  Renderer::Statistics statistics;
  const CentralEye eye(camera);
  const std::vector<simd::LightSource> sources = light_sources(setting.lights, setting.options.falloff);
  Shader shader(eye, sources, expected.lights, setting.options, statistics, materials);
  for (int row = 0; row < setting.grid.rows(); ++row) {
    for (int column = 0; column < setting.grid.columns(); ++column) {
      Sample sample;
      shader.shade(setting.grid.map_point(column, row), 1.0 / setting.grid.per_side, sample);
      expected.nearest.faces.push_back(sample.face);
      expected.samples.push_back(sample);
    }
  }
  return expected;
}

// Asks the lights' maps about the points whose bits are set, moved ones by their own positions.
void ask_lights(const Setting& setting, const ListsOfLights& lights, const MovedPoints& moved, SeenPoints& seen) {
  const auto columns = static_cast<std::uint32_t>(setting.grid.columns());
  const std::size_t seen_count = seen.points.size() - moved.numbers.size();
  for (std::size_t i = 0; i < seen.points.size(); ++i) {
    const auto is_lit = [&](const LightLists& light) {
      if (i >= seen_count) return light.is_lit(moved.position_of(static_cast<std::uint32_t>(i)), nullptr);
      const std::uint32_t sample = seen.points.samples[i], face = seen.points.faces[i];
      const Triangle triangle = triangle_of(setting.scene, face);
      const Vector& K = setting.grid.frame.position();
      const Vector d = setting.grid.direction(static_cast<int>(sample % columns), static_cast<int>(sample / columns));
      return !light.is_blocked(SurfacePoint{K, d, triangle, static_cast<FaceId>(face), side(triangle, K)}, nullptr);
    };
    for (std::size_t l = 0; l < lights.size(); ++l) {
      std::uint8_t& mask = seen.masks[i * seen.stride + l / 8];
      if ((mask >> (l % 8) & 1) != 0 && !is_lit(*lights[l])) mask &= static_cast<std::uint8_t>(~(1u << (l % 8)));
    }
  }
  give_back(moved, seen);
  EXPECT_EQ(seen.points.size(), seen_count);
}

bool same_bits(const Color& a, const Color& b) { return std::memcmp(&a, &b, sizeof(Color)) == 0; }

void expect_same(const Setting& setting, const Expected& expected, const Executor& executor, std::size_t* moved_count,
                 const MaterialTable* materials = nullptr) {
  SeenPoints seen =
      find_seen_points(setting.scene, setting.grid, expected.nearest, LightPlaces::of(setting.lights), executor);
  const MovedPoints moved =
      find_moved_points(setting.scene, setting.grid, seen, setting.lights, setting.options, executor);
  *moved_count += moved.positions.size();
  clear_unreached(setting.scene, setting.grid, seen, setting.lights, executor);
  ask_lights(setting, expected.lights, moved, seen);
  std::vector<Color> colors(setting.grid.count(), setting.options.background);
  shade_points(setting.scene, setting.grid, seen, setting.lights, setting.options, executor, colors, materials);
  for (std::size_t i = 0; setting.options.planes.has(Plane::Lights) && i < seen.points.size(); ++i) {
    const std::vector<std::uint8_t>& lights = expected.samples[seen.points.samples[i]].lights;
    for (std::size_t byte = 0; byte < seen.stride; ++byte) {
      ASSERT_EQ(seen.masks[i * seen.stride + byte], lights[byte]) << "sample " << seen.points.samples[i];
    }
  }
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const Color &a = colors[i], &b = expected.samples[i].color;
    ASSERT_TRUE(same_bits(a, b)) << "sample " << i << ": " << a.r << " " << a.g << " " << a.b << ", not " << b.r << " "
                                 << b.g << " " << b.b;
  }
}

void expect_bits_of_the_shader(bool has_materials, std::uint64_t seeds) {
  const simd::Target before = simd::active_target();
  std::size_t moved_count = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Setting setting = make_setting(random, has_materials);
    std::unique_ptr<MaterialTable> materials;
    if (has_materials) {
      materials = std::make_unique<MaterialTable>(setting.scene, 1000, Executor(1));
      ASSERT_TRUE(materials->warnings().empty()) << materials->warnings()[0];
    }
    const Expected expected = shade_singly(setting, materials.get());
    for (const simd::Target target : simd::supported_targets()) {
      SCOPED_TRACE(simd::name_of(target));
      simd::set_active_target(target);
      expect_same(setting, expected, Executor(1 + static_cast<int>(seed % 3)), &moved_count, materials.get());
    }
    simd::set_active_target(before);
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(moved_count, 1000u);
}

TEST(ShadePicture, GivesTheBitsOfTheShader) { expect_bits_of_the_shader(false, 120); }

TEST(ShadePicture, GivesTheBitsOfTheShaderWithMaterials) { expect_bits_of_the_shader(true, 120); }

// More points than a task takes: threads share them.
TEST(ShadePicture, IsTheSameForAnyNumberOfThreads) {
  Random random(5);
  TestScene ball = make_scene(Kind::Ball, 500, random);
  add_normals(ball.mesh, random);
  const Vector camera = ball.centre + Vector(0, 0, static_cast<float>(3 * ball.radius));
  const Setting setting{Scene(ball.mesh),
                        {SpaceVector::looking_at(camera, ball.centre, Vector(0, 1, 0)),
                         Projection(ProjectionKind::Surface, 0.8, 130, 120), 1},
                        {{camera, {1, 0.5f, 0.25f}, 1}, {ball.centre + Vector(5, 6, 7), {1, 1, 1}, 2}},
                        {}};
  const Expected expected = shade_singly(setting);
  for (int threads = 1; threads <= 3; ++threads) {
    std::size_t moved_count = 0;
    expect_same(setting, expected, Executor(threads), &moved_count);
    EXPECT_GT(moved_count, 100u);
  }
}

}  // namespace
