// Golden pictures of every material, light, camera and way of sampling (support/golden.h).

#include <facemap/image_file.h>
#include <gtest/gtest.h>

#include "support/golden.h"

namespace {

using namespace facemap;
using golden::Golden;
using golden::Subject;
using Wrap = TextureUse::Wrap;

constexpr double kDegree = 0.017453292519943295;

Material& material_of(Subject& subject) { return subject.model.materials[0]; }

void make_metal(Subject& subject, float metallic, float roughness) {
  Material& material = material_of(subject);
  material.kind = Material::Kind::MetalRough;
  material.diffuse = {0.75f, 0.5f, 0.25f};
  material.metallic = metallic;
  material.roughness = roughness;
}

void make_shiny(Subject& subject) {
  Material& material = material_of(subject);
  material.diffuse = Vector(0.375f);
  material.specular = Vector(0.5f);
  material.shininess = 32;
}

/// Four colours with hard edges between texels: what wraps and transforms do is plain to see.
TextureUse& texture_of(Subject& subject) {
  TextureUse& use = material_of(subject).diffuse_map;
  use.image = 0;
  use.is_smooth = false;
  return use;
}

void wrap(Subject& subject, Wrap u, Wrap v) {
  TextureUse& use = texture_of(subject);
  use.wrap_u = u;
  use.wrap_v = v;
}

void cut_out(Subject& subject, int image) {
  Material& material = material_of(subject);
  material.alpha = Material::Alpha::Mask;
  (image == 2 ? material.diffuse_map : material.opacity_map).image = static_cast<std::uint32_t>(image);
}

TEST(GoldenPictures, OfEachMaterial) {
  const Golden table[] = {
      {"diffuse", 0xe3f38c3c9ae0c30d,
       [](Subject& s) {
         material_of(s).diffuse = {0.75f, 0.5f, 0.25f};
       }},
      {"without materials", 0x5ba8ed3c4daa23fd, [](Subject& s) { s.options.materials = false; }},
      {"vertex colours", 0xd0128d3c0546fa8a,
       [](Subject& s) {
         for (const Vector& p : s.model.mesh.positions) s.model.mesh.colours.push_back((p + 4.0f) * 0.125f);
       }},
      {"flat", 0x765220e5546cb040, [](Subject& s) { s.options.normals = Renderer::Normals::Flat; }},
      {"without the terminator fix", 0x37c340f890e918fa, [](Subject& s) { s.options.shadow_terminator_fix = false; }},
      {"phong", 0x5a9495001262b630, make_shiny},
      {"phong without highlights", 0x42f53543d09fa4b4,
       [](Subject& s) {
         make_shiny(s);
         material_of(s).illumination = 1;
       }},
      {"rough metal", 0xa7deb508e4f995c8, [](Subject& s) { make_metal(s, 1, 0.5f); }},
      {"smooth plastic", 0x6650fd03de720e69, [](Subject& s) { make_metal(s, 0, 0.125f); }},
      {"emission", 0xb8d67cdaa347d3e7,
       [](Subject& s) {
         material_of(s).emission = {0.25f, 0.5f, 0.125f};
       }},
      {"unlit", 0xf551aab02c13417a,
       [](Subject& s) {
         material_of(s).is_unlit = true;
         texture_of(s);
       }},
      {"alpha of the texture", 0xe816f5e613dfc79e, [](Subject& s) { cut_out(s, 2); }},
      {"opacity map", 0x63e6290dc5cd7f5a, [](Subject& s) { cut_out(s, 1); }},
  };
  golden::expect_hashes(table);
}

TEST(GoldenPictures, OfEachTexture) {
  const Golden table[] = {
      {"diffuse map", 0x752a21b85027f7ab, [](Subject& s) { material_of(s).diffuse_map.image = 1; }},
      {"texels as squares", 0xb1543ff5a1cb2e50, [](Subject& s) { texture_of(s); }},
      {"v down", 0xdcbe9bf220a6875d, [](Subject& s) { texture_of(s).is_v_down = true; }},
      {"mirror and clamp", 0x6339f22296591647, [](Subject& s) { wrap(s, Wrap::Mirror, Wrap::Clamp); }},
      {"clamp and repeat", 0xa3856cb991db2008, [](Subject& s) { wrap(s, Wrap::Clamp, Wrap::Repeat); }},
      {"transform", 0x31befe9a86cc69d0,
       [](Subject& s) {
         TextureUse& use = texture_of(s);
         use.offset = {0.25f, 0.125f};
         use.scale = {1.5f, 2};
         use.rotation = 0.5f;
       }},
      {"base and gain", 0x6fd19057c0f06cfa,
       [](Subject& s) {
         texture_of(s).base = 0.25f;
         texture_of(s).gain = 0.5f;
       }},
      {"jpeg", 0x33d64accf42e9c2d,
       [](Subject& s) {
         std::vector<std::uint8_t> levels;
         for (int i = 0; i < 32 * 32; ++i) {
           for (const int level : {i % 32 * 8, i / 32 * 8, i % 7 * 32}) {
             levels.push_back(static_cast<std::uint8_t>(level));
           }
         }
         s.model.images[1] = {"a.jpg", {}, encode_jpeg({32, 32, 3, std::span<const std::uint8_t>(levels)}, 90)};
         material_of(s).diffuse_map.image = 1;
       }},
      {"specular and shininess maps", 0x5422aced31f24bf0,
       [](Subject& s) {
         make_shiny(s);
         material_of(s).specular_map.image = 0;
         material_of(s).shininess_map.image = 1;
       }},
      {"emission map", 0x50a62992512e4a7d,
       [](Subject& s) {
         material_of(s).emission = Vector(0.5f);
         material_of(s).emission_map.image = 1;
       }},
      {"metallic map", 0x0e1143772d979c95,
       [](Subject& s) {
         make_metal(s, 1, 0.25f);
         material_of(s).metallic_map.image = 1;
         material_of(s).metallic_map.channel = 1;
       }},
      {"roughness map", 0x65b428a36f77f156,
       [](Subject& s) {
         make_metal(s, 1, 1);
         material_of(s).roughness_map.image = 1;
         material_of(s).roughness_map.channel = 0;
       }},
      {"normal map", 0x5f6ea3d3b38160b1, [](Subject& s) { material_of(s).normal_map.image = 1; }},
      {"weak normal map", 0xcd644c6bd705505c,
       [](Subject& s) {
         material_of(s).normal_map.image = 1;
         material_of(s).normal_map.strength = 0.25f;
       }},
      {"bump map", 0xba962f04dbf56d27, [](Subject& s) { material_of(s).bump_map.image = 1; }},
      {"strong bump map, mirrored", 0x67f34d4b4db941cc,
       [](Subject& s) {
         material_of(s).bump_map.image = 1;
         material_of(s).bump_map.strength = 4;
         material_of(s).bump_map.wrap_u = material_of(s).bump_map.wrap_v = Wrap::Mirror;
       }},
  };
  golden::expect_hashes(table);
}

Light light_of(Light::Kind kind) {
  Light light;
  light.kind = kind;
  light.position = {2, 4, 5};
  light.direction = {-0.5f, -0.75f, -1};
  light.color = {1, 0.875f, 0.75f};
  light.inner_angle = 0.125;
  light.outer_angle = 0.375;
  return light;
}

TEST(GoldenPictures, OfEachLight) {
  const Golden table[] = {
      {"none", 0x87a27095d92d0f3b, [](Subject& s) { s.lights.clear(); }},
      {"point", 0x3c0c24d637091f9b, [](Subject& s) { s.lights = {light_of(Light::Kind::Point)}; }},
      {"spot", 0x063df5f913e41ea2, [](Subject& s) { s.lights = {light_of(Light::Kind::Spot)}; }},
      {"directional", 0x287bc75c76ab3f98, [](Subject& s) { s.lights = {light_of(Light::Kind::Directional)}; }},
      {"range", 0x2babafd39bcb051b,
       [](Subject& s) {
         s.lights = {light_of(Light::Kind::Point)};
         s.lights[0].range = 6.5;
       }},
      {"falloff of its own", 0x5e589aafae12e74e,
       [](Subject& s) {
         s.lights = {light_of(Light::Kind::Spot)};
         s.lights[0].has_falloff = true;
         s.lights[0].intensity = 40;
       }},
      {"falloff of all", 0x97fefc5a88564b8e,
       [](Subject& s) {
         s.options.falloff = Renderer::Falloff::InverseSquare;
         for (Light& light : s.lights) light.intensity *= 30;
       }},
      {"among the faces", 0xc595527cd25b3cb6,
       [](Subject& s) {
         s.lights = {light_of(Light::Kind::Point)};
         s.lights[0].position = {0.5f, 0.5f, 2};
       }},
      {"all kinds", 0x2b1a402d133fc82d,
       [](Subject& s) {
         for (const auto kind : {Light::Kind::Directional, Light::Kind::Spot, Light::Kind::Point}) {
           s.lights.push_back(light_of(kind));
         }
       }},
      {"twelve", 0xf9a6256b45348dab,
       [](Subject& s) {
         s.lights.clear();
         for (int i = 0; i < 12; ++i) {
           const auto x = static_cast<float>(i % 4), y = static_cast<float>(i / 4);
           s.lights.push_back({{3 * x - 5, y + 2, 6 - 2 * y}, {0.125f, 0.0625f * x, 0.125f * y}, 1});
         }
       }},
      {"ambient", 0x4b4ab17d72e60fa0,
       [](Subject& s) {
         s.options.ambient = {0.25f, 0.125f, 0.0625f};
       }},
      {"two skies, z up", 0xc3e6eefd3b0adc2b,
       [](Subject& s) {
         s.lights.clear();
         s.options.sky_up = {0.5f, 0.625f, 0.75f};
         s.options.sky_down = {0.25f, 0.125f, 0};
         s.options.up = {0, 0, 1};
       }},
  };
  golden::expect_hashes(table);
}

/// From among the dome and the boxes, with something to see on every side.
void look_around(Subject& subject, const Lens& lens) {
  subject.view.position = {0.25f, 0.5f, 2.5f};
  subject.view.look_at = {0, 0.25f, 0};
  subject.view.lens = lens;
  subject.options.width = lens.width();
  subject.options.height = lens.height();
}

TEST(GoldenPictures, OfEachCamera) {
  const Golden table[] = {
      {"surface 50", 0xa8750372924845ed, [](Subject& s) { look_around(s, Lens::surface(50 * kDegree, 64, 64)); }},
      {"surface 180", 0x04ebb578059cb3cc, [](Subject& s) { look_around(s, Lens::surface(180 * kDegree, 64, 64)); }},
      {"surface 360", 0xee9b59601307b0d9, [](Subject& s) { look_around(s, Lens::surface(360 * kDegree, 64, 64)); }},
      {"surface, wide", 0x3846fc283f6e8be7, [](Subject& s) { look_around(s, Lens::surface(120 * kDegree, 64, 40)); }},
      {"plane 50", 0x94ea28dc59ef3482, [](Subject& s) { look_around(s, Lens::plane(50 * kDegree, 64, 64)); }},
      {"plane 150", 0xad9c9781ce525f6b, [](Subject& s) { look_around(s, Lens::plane(150 * kDegree, 64, 40)); }},
      {"equirectangular", 0x3a8570b19aac6071, [](Subject& s) { look_around(s, Lens::equirectangular(64, 32)); }},
      {"cube 3x2", 0x60f6ac63cb1c55ca, [](Subject& s) { look_around(s, Lens::cube_map(CubeLayout::Grid3x2, 21)); }},
      {"cube 6x1", 0xed3c3ee17f224f08, [](Subject& s) { look_around(s, Lens::cube_map(CubeLayout::Row6x1, 21)); }},
      {"cube 1x6", 0x1b30279cc883e768, [](Subject& s) { look_around(s, Lens::cube_map(CubeLayout::Column1x6, 21)); }},
      {"opencv pinhole", 0x0ce1ece05368f3d3,
       [](Subject& s) {
         const PinholeDistortion bent = {-0.25, 0.0625, 0.001, -0.002, 0.01};
         look_around(s, Lens::opencv_pinhole({50, 52, 31, 33}, bent, 64, 64));
       }},
      {"opencv rational pinhole", 0x0f585eb3e9e7e2a8,
       [](Subject& s) {
         const PinholeDistortion bent = {5.25, 2.125, -0.0007, 0.0004, 0.0625, 5.5, 3.375, 0.5};
         look_around(s, Lens::opencv_pinhole({40, 40, 31.5, 31.5}, bent, 64, 64));
       }},
      {"opencv fisheye", 0x8d193ff46c6bc5b5,
       [](Subject& s) {
         look_around(s, Lens::opencv_fisheye({18, 18, 31.5, 32}, {-0.0125, 0.004, -0.003, 0.0005}, 64, 64));
       }},
      {"orthographic", 0xa4fdbbdf491db4bc,
       [](Subject& s) {
         s.view.is_parallel = true;
         s.view.height = 5;
       }},
      {"orthographic, among the faces", 0xdc149b0b07533e62,
       [](Subject& s) {
         s.view.position = {0.25f, 0.5f, 1};
         s.view.look_at = {0, 0.25f, 0};
         s.view.is_parallel = true;
         s.view.height = 8;
       }},
      {"odd up", 0x026dfc221980aad3,
       [](Subject& s) {
         s.view.up = {1, 2, 0.5f};
       }},
  };
  golden::expect_hashes(table);
}

void sample(Subject& subject, Renderer::Sampling sampling, Renderer::Filter filter) {
  texture_of(subject);
  subject.options.samples = 3;
  subject.options.sampling = sampling;
  subject.options.filter = filter;
}

TEST(GoldenPictures, OfEachWayOfSampling) {
  using Sampling = Renderer::Sampling;
  using Filter = Renderer::Filter;
  const Golden table[] = {
      {"one", 0xb1543ff5a1cb2e50, [](Subject& s) { texture_of(s); }},
      {"grid", 0x55d042136cc95a75, [](Subject& s) { sample(s, Sampling::Grid, Filter::Box); }},
      {"edges", 0x1f549c64131a7a6f, [](Subject& s) { sample(s, Sampling::Edges, Filter::Box); }},
      {"grid, blackman-harris", 0x61364447a9931fee,
       [](Subject& s) { sample(s, Sampling::Grid, Filter::BlackmanHarris); }},
      {"edges, blackman-harris", 0x0265674134756f1d,
       [](Subject& s) { sample(s, Sampling::Edges, Filter::BlackmanHarris); }},
      {"wide blackman-harris", 0x006b7269a98c28d3,
       [](Subject& s) {
         sample(s, Sampling::Grid, Filter::BlackmanHarris);
         s.options.filter_width = 4;
       }},
      {"crop", 0x675948d225a91e29,
       [](Subject& s) {
         sample(s, Sampling::Grid, Filter::Box);
         s.options.crop = PixelBox{13, 17, 40, 29};
       }},
      {"crop of edges, blackman-harris", 0x2991337c63a35273,
       [](Subject& s) {
         sample(s, Sampling::Edges, Filter::BlackmanHarris);
         s.options.crop = PixelBox{13, 17, 40, 29};
       }},
      {"background", 0x7fac8117268acf2c,
       [](Subject& s) {
         sample(s, Sampling::Edges, Filter::Box);
         s.options.background = {0.25f, 0.5f, 0.75f};
       }},
  };
  golden::expect_hashes(table);
}

}  // namespace
