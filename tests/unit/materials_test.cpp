// Pictures of materials, from a model to pixels.

#include <facemap/error.h>
#include <facemap/renderer.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <functional>

#include "simd/target.h"

namespace facemap {
namespace {

constexpr int kSize = 64;

// Image: red, green over blue, white.
TextureImage four_colours() {
  Image image;
  image.width = image.height = 2;
  for (const std::uint32_t rgb : {0xff0000, 0x00ff00, 0x0000ff, 0xffffff}) {
    image.pixels.push_back(Color::from_24_bit(rgb));
  }
  return {"four.png", {}, encode_png(image)};
}

// Grey bumps and dents, as heights or as what a normal map would hardly hold: any numbers serve a hash.
TextureImage waves() {
  Image image;
  image.width = image.height = 16;
  for (std::uint32_t i = 0; i < 256; ++i) {
    const std::uint32_t grey = (i * i / 7 + i) % 256;
    image.pixels.push_back(Color::from_24_bit(grey << 16 | (255 - grey) << 8 | 255));
  }
  return {"waves.png", {}, encode_png(image)};
}

// A square of side 2 about the origin in z = 0, seen from +z, its texture coordinates from its lower left corner.
Mesh square_mesh() {
  Mesh mesh;
  mesh.positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  mesh.texture_coordinates = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  mesh.triangles = mesh.texture_corners = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

Model square(const Material& material) {
  Model model;
  model.mesh = square_mesh();
  model.mesh.triangle_materials = {0, 0};
  model.materials = {material};
  model.images = {four_colours(), waves()};
  return model;
}

View front() {
  View view;
  view.position = {0, 0, 4};
  view.look_at = {0, 0, 0};
  view.projection = ProjectionKind::Plane;
  return view;
}

const std::vector<Light> kLight{{{0, 0, 100}, {1, 1, 1}, 1}};

Renderer::Options small() {
  Renderer::Options options;
  options.width = options.height = kSize;
  return options;
}

Image picture(const Scene& scene, const Renderer::Options& options = small(), const View& view = front(),
              const std::vector<Light>& lights = kLight) {
  return Renderer(scene, view, lights, options).render();
}

// The colour at a place of the square, x to the right and y up, -1..1.
Color at(const Image& image, double x, double y) {
  const double scale = kSize / 2 / (4 * 0.46630765815499859);  // tan 25 degrees
  const auto column = static_cast<std::size_t>(kSize / 2 + x * scale),
             row = static_cast<std::size_t>(kSize / 2 - y * scale);
  return image.pixels[row * static_cast<std::size_t>(kSize) + column];
}

void expect_colour(const Color& color, double r, double g, double b, double tolerance = 0.01) {
  EXPECT_NEAR(color.r, r, tolerance);
  EXPECT_NEAR(color.g, g, tolerance);
  EXPECT_NEAR(color.b, b, tolerance);
}

Material with_diffuse_map() {
  Material material;
  material.diffuse = Vector(1);
  material.diffuse_map.image = 0;
  material.diffuse_map.is_smooth = false;
  return material;
}

TEST(Materials, TexturesStandUprightAndAreNotMirrored) {
  const Image image = picture(Scene(square(with_diffuse_map())));
  expect_colour(at(image, -0.5, 0.5), 1, 0, 0);
  expect_colour(at(image, 0.5, 0.5), 0, 1, 0);
  expect_colour(at(image, -0.5, -0.5), 0, 0, 1);
  expect_colour(at(image, 0.5, -0.5), 1, 1, 1);
  Material flipped = with_diffuse_map();
  flipped.diffuse_map.is_v_down = true;
  expect_colour(at(picture(Scene(square(flipped))), -0.5, 0.5), 0, 0, 1);
}

TEST(Materials, AFisheyeSeesTheSameTexture) {
  View view = front();
  view.projection = ProjectionKind::Surface;
  const Image image = picture(Scene(square(with_diffuse_map())), small(), view);
  expect_colour(at(image, -0.5, 0.5), 1, 0, 0);
  expect_colour(at(image, 0.5, 0.5), 0, 1, 0);
}

TEST(Materials, WithoutThemAllIsWhite) {
  Renderer::Options options = small();
  options.materials = false;
  const Model model = square(with_diffuse_map());
  const Image white = picture(Scene(model), options), bare = picture(Scene(square_mesh()));
  EXPECT_EQ(white.pixels, bare.pixels);
  expect_colour(at(white, -0.5, 0.5), 1, 1, 1);
}

TEST(Materials, DiffuseFactorAndVertexColoursMultiply) {
  Material material = with_diffuse_map();
  material.diffuse = {0.5f, 0.25f, 1};
  Model model = square(material);
  expect_colour(at(picture(Scene(model)), 0.5, -0.5), 0.5, 0.25, 1);
  model.mesh.colours.assign(4, Vector(0.5f, 1, 0));
  expect_colour(at(picture(Scene(model)), 0.5, -0.5), 0.25, 0.25, 0);
  model.materials.clear();
  model.mesh.triangle_materials.clear();
  expect_colour(at(picture(Scene(model)), 0.5, -0.5), 0.5, 1, 0);
}

TEST(Materials, FacesWithoutTextureCoordinatesHaveNoTextures) {
  Material material = with_diffuse_map();
  material.diffuse = {0.5f, 0.25f, 0.125f};
  Model model = square(material);
  model.mesh.texture_corners[1] = {kNoIndex, kNoIndex, kNoIndex};
  const Image image = picture(Scene(model));
  expect_colour(at(image, -0.5, 0.6), 0.5, 0.25, 0.125);
  expect_colour(at(image, 0.6, -0.5), 0.5, 0.25, 0.125);
  expect_colour(at(image, -0.5, -0.7), 0, 0, 0.125);
}

TEST(Materials, FacesWithoutOneAreWhite) {
  Model model = square(with_diffuse_map());
  model.mesh.triangle_materials = {kNoIndex, 0};
  expect_colour(at(picture(Scene(model)), 0.5, -0.6), 1, 1, 1);
}

TEST(Materials, EmissionAndUnlitColoursNeedNoLight) {
  Material material;
  material.emission = {0.25f, 0, 0.5f};
  expect_colour(at(picture(Scene(square(material)), small(), front(), {}), 0, 0), 0.25, 0, 0.5);
  Material unlit = with_diffuse_map();
  unlit.is_unlit = true;
  unlit.emission = {1, 1, 1};
  expect_colour(at(picture(Scene(square(unlit))), -0.5, 0.5), 1, 0, 0);
  expect_colour(at(picture(Scene(square(unlit)), small(), front(), {}), -0.5, 0.5), 1, 0, 0);
}

TEST(Materials, AmbientAndSkyLightReachWhatNoLightDoes) {
  Material material;
  material.diffuse = {0.5f, 0.5f, 0.5f};
  Renderer::Options options = small();
  options.ambient = {0.25f, 0, 0};
  options.sky_up = {0, 1, 0};
  options.sky_down = {0, 0, 1};
  for (const bool materials : {true, false}) {
    options.materials = materials;
    const double albedo = materials ? 0.5 : 1;
    const Scene scene(square(material));
    options.up = {0, 1, 0};  // the horizon: half of each
    expect_colour(at(picture(scene, options, front(), {}), 0, 0), 0.25 * albedo, 0.5 * albedo, 0.5 * albedo, 1e-6);
    options.up = {0, 0, 3};  // the square looks straight up
    expect_colour(at(picture(scene, options, front(), {}), 0, 0), 0.25 * albedo, albedo, 0, 1e-6);
  }
  options.up = {0, 0, 0};
  EXPECT_THROW(Renderer(Scene(square(material)), front(), {}, options), Error);
  options.up = {0, 1, 0};
  options.sky_down.g = -1;
  EXPECT_THROW(Renderer(Scene(square(material)), front(), {}, options), Error);
}

TEST(Materials, HighlightsStandWhereLightIsMirrored) {
  Material material;
  material.diffuse = Vector(0.25f);
  material.specular = Vector(0.5f);
  material.shininess = 500;
  const Image image = picture(Scene(square(material)), small(), front(), {{{0, 0, 4}, {1, 1, 1}, 1}});
  EXPECT_NEAR(at(image, 0, 0).r, 0.75, 0.02);
  EXPECT_NEAR(at(image, 0.9, 0).r, 0.25 * 4 / std::sqrt(16 + 0.81), 0.01);
  material.illumination = 1;
  EXPECT_NEAR(at(picture(Scene(square(material))), 0, 0).r, 0.25, 0.02);
}

// Light from the right, on a map whose normals lean to the right: more light than straight on, and less from the left.
TEST(Materials, NormalMapsLeanAsTheImageSays) {
  Image leaning;
  leaning.width = leaning.height = 1;
  leaning.pixels = {Color::from_24_bit(0xc880e0)};  // (0.57, 0, 0.76)
  for (const bool behind : {false, true}) {
    Material material;
    material.diffuse = Vector(1);
    material.normal_map.image = 2;
    Model model = square(material);
    model.images.push_back({"normal.png", {}, encode_png(leaning)});
    const float z = behind ? -1.0f : 1.0f;
    View view = front();
    view.position.z *= z;
    const auto lit_from = [&](float x) {
      const Image image = picture(Scene(model), small(), view, {{{100 * x, 0, 100 * z}, {1, 1, 1}, 1}});
      return at(image, 0, 0).r;
    };
    // From behind, what leaned to the right now leans to the left.
    EXPECT_NEAR(lit_from(z), 0.99, 0.03) << behind;
    EXPECT_NEAR(lit_from(-z), 0.12, 0.04) << behind;
  }
}

TEST(Materials, BumpsRiseWhereTheImageIsBright) {
  Image slope;
  slope.width = 8;
  slope.height = 1;
  for (std::uint32_t i = 0; i < 8; ++i) slope.pixels.push_back(Color::from_24_bit(0x202020 * i));
  Material material;
  material.diffuse = Vector(1);
  material.bump_map.image = 2;
  material.bump_map.strength = 8;  // a level of 1/8 a texel: 45 degrees
  Model model = square(material);
  model.images.push_back({"slope.png", {}, encode_png(slope)});
  // It rises to the right, so that it is turned to the left.
  const auto lit_from = [&](float x) {
    return at(picture(Scene(model), small(), front(), {{{x, 0, 100}, {1, 1, 1}, 1}}), 0, 0).r;
  };
  EXPECT_GT(lit_from(-100), 0.9);
  EXPECT_LT(lit_from(100), 0.2);
}

// Light does not pass through a face whose relief is turned to it.
TEST(Materials, LightFromBehindAddsNothing) {
  Material material;
  material.diffuse = Vector(1);
  material.bump_map.image = 1;
  material.bump_map.strength = 30;
  for (const Color& color : picture(Scene(square(material)), small(), front(), {{{50, 0, -1}, {1, 1, 1}, 1}}).pixels) {
    EXPECT_EQ(color, Color());
  }
}

TEST(Materials, BrokenAndLargeImagesAreWarnings) {
  Model model = square(with_diffuse_map());
  model.images[0].bytes.resize(30);
  const Scene broken(model);
  Renderer renderer(broken, front(), kLight, small());
  expect_colour(at(renderer.render(), -0.5, 0.5), 1, 1, 1);
  ASSERT_EQ(renderer.statistics().warnings.size(), 1u);
  EXPECT_NE(renderer.statistics().warnings[0].find("four.png"), std::string::npos);
  EXPECT_TRUE(renderer.look().ids.size() > 0);

  Renderer::Options options = small();
  options.max_texture_pixels = 3;
  const Scene large(square(with_diffuse_map()));
  Renderer limited(large, front(), kLight, options);
  limited.render();
  EXPECT_EQ(limited.statistics().warnings.size(), 1u);

  model.materials[0].diffuse_map.image = 7;
  EXPECT_THROW(Scene{model}, Error);
}

// Pictures that stand for a kind of material each: the same bits on every machine, target and number of threads, by
// lists and without.

std::uint64_t hash_of(const Image& image) {
  std::uint64_t hash = 0xcbf29ce484222325u;  // FNV-1a
  for (const Color& color : image.pixels) {
    for (const float channel : {color.r, color.g, color.b}) {
      hash = (hash ^ std::bit_cast<std::uint32_t>(channel)) * 0x100000001b3u;
    }
  }
  return hash;
}

// A ball with texture coordinates over a floor.
Model ball_and_floor(const Material& material) {
  Model model = square(material);
  Mesh& mesh = model.mesh;
  mesh.positions = {{-3, -1, -3}, {3, -1, -3}, {3, -1, 3}, {-3, -1, 3}};
  mesh.triangles = mesh.texture_corners = {{0, 2, 1}, {0, 3, 2}};
  mesh.normals = {};
  mesh.normal_corners = {{kNoIndex, kNoIndex, kNoIndex}, {kNoIndex, kNoIndex, kNoIndex}};
  constexpr std::uint32_t kSides = 6;
  const auto first = static_cast<std::uint32_t>(mesh.positions.size());
  // Points of a cube's top and sides pushed out to the ball: no sine of the machine's.
  for (std::uint32_t j = 0; j <= kSides; ++j) {
    for (std::uint32_t i = 0; i <= kSides; ++i) {
      const float x = 2.0f * static_cast<float>(i) / kSides - 1, y = 2.0f * static_cast<float>(j) / kSides - 1;
      const float z = 1.2f - x * x * 0.6f - y * y * 0.6f;
      mesh.positions.push_back({x, y, z});
      mesh.normals.push_back({1.2f * x, 1.2f * y, 1});
      mesh.texture_coordinates.push_back({x, y});
    }
  }
  for (std::uint32_t j = 0; j < kSides; ++j) {
    for (std::uint32_t i = 0; i < kSides; ++i) {
      const std::uint32_t a = j * (kSides + 1) + i, b = a + 1, c = a + kSides + 1, d = c + 1;
      for (const Corners& corners : {Corners{a, b, d}, Corners{a, d, c}}) {
        mesh.triangles.push_back({corners[0] + first, corners[1] + first, corners[2] + first});
        mesh.texture_corners.push_back({corners[0] + 4, corners[1] + 4, corners[2] + 4});
        mesh.normal_corners.push_back(corners);
      }
    }
  }
  mesh.triangle_materials.assign(mesh.triangles.size(), 0);
  return model;
}

struct Golden {
  const char* name;
  std::uint64_t hash;
  std::function<void(Material&)> change;
};

const Golden kGolden[] = {
    {"diffuse", 0xdce238db74d8894e,
     [](Material& m) {
       m.diffuse = {0.75f, 0.5f, 0.25f};
     }},
    {"texture", 0x55382a61861e892f, [](Material& m) { m.diffuse_map.image = 0; }},
    {"phong", 0xdde5dc14af808fd3,
     [](Material& m) {
       m.diffuse = Vector(0.4f);
       m.specular = Vector(0.5f);
       m.shininess = 30;
     }},
    {"phong maps", 0x53c8d2f71f8828d8,
     [](Material& m) {
       m.shininess = 60;
       m.specular = Vector(1);
       m.specular_map.image = 0;
       m.shininess_map.image = 1;
       m.emission = Vector(0.25f);
       m.emission_map.image = 1;
     }},
    {"metal", 0xdc48472743a2d9ec,
     [](Material& m) {
       m.kind = Material::Kind::MetalRough;
       m.metallic = 1;
       m.roughness = 0.3f;
     }},
    {"metal-rough maps", 0xdd518908eddf6b05,
     [](Material& m) {
       m.kind = Material::Kind::MetalRough;
       m.metallic = 1;
       m.metallic_map.image = m.roughness_map.image = 1;
       m.metallic_map.channel = 2;
       m.roughness_map.channel = 1;
     }},
    {"normal map", 0x9ed90e984f680d4a, [](Material& m) { m.normal_map.image = 1; }},
    {"bump map", 0xbb6cf2ae3e428a4c,
     [](Material& m) {
       m.bump_map.image = 1;
       m.bump_map.wrap_u = TextureUse::Wrap::Mirror;
       m.bump_map.wrap_v = TextureUse::Wrap::Clamp;
     }},
    {"unlit", 0xe9e90d5a9f2d78a3,
     [](Material& m) {
       m.is_unlit = true;
       m.diffuse_map.image = 1;
     }},
};

TEST(Materials, PicturesOfEachKindHaveTheSameBitsEverywhere) {
  const simd::Target before = simd::active_target();
  for (const Golden& golden : kGolden) {
    SCOPED_TRACE(golden.name);
    Material material;
    golden.change(material);
    const Scene scene(ball_and_floor(material));
    View view;
    view.position = {2, 2, 5};
    view.look_at = {0, 0, 0};
    Renderer::Options options = small();
    options.samples = 2;
    options.sky_up = {0.25f, 0.25f, 0.5f};
    const std::vector<Light> lights{{{3, 4, 5}, {1, 0.75f, 0.5f}, 0.75f}, {{-4, 2, 3}, {0.5f, 0.75f, 1}, 0.5f}};
    for (const simd::Target target : simd::supported_targets()) {
      simd::set_active_target(target);
      for (const auto strategy : {Renderer::Strategy::Lists, Renderer::Strategy::Transposed}) {
        options.strategy = strategy;
        options.threads = 1 + (strategy == Renderer::Strategy::Transposed);
        EXPECT_EQ(hash_of(picture(scene, options, view, lights)), golden.hash) << simd::name_of(target);
      }
    }
    simd::set_active_target(before);
    // The paper's renderer asks sample by sample.
    options.samples = 1;
    const Image together = picture(scene, options, view, lights);
    options.sampling = Renderer::Sampling::Edges;
    EXPECT_EQ(picture(scene, options, view, lights).pixels, together.pixels);
  }
}

}  // namespace
}  // namespace facemap
