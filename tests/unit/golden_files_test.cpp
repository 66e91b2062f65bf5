#include <facemap/compare.h>
#include <facemap/generators.h>
#include <facemap/image_file.h>
#include <facemap/renderer.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>
#include <functional>

#include "simd/target.h"
#include "support/golden.h"

// What is read back from a file of each format: libraries may compress differently, numbers and levels are the same.

namespace {

using namespace facemap;
namespace fs = std::filesystem;
using Bytes = std::vector<std::uint8_t>;

std::uint64_t hash_of_file(const Bytes& bytes) {
  std::string name = (fs::temp_directory_path() / "facemap-golden-XXXXXX").string();
  const fs::path folder = mkdtemp(name.data());
  write_file(folder / "file", bytes);
  const PictureChannels picture = read_picture(folder / "file");
  fs::remove_all(folder);
  golden::Hash hash;
  for (const auto& channel : picture.channels) {
    std::visit(
        [&](const auto& values) {
          for (const auto value : values) hash.add(value);
        },
        channel.values);
  }
  return hash.value();
}

Bytes exr_of_planes(const Image& image) {
  std::vector<ExrLayers> layers;
  for (const Plane plane : all_planes()) layers.push_back(plane_layers(image, plane));
  return encode_exr(layers);
}

struct GoldenFile {
  const char* name;
  std::uint64_t hash;
  std::function<Bytes(const Image&)> encode;
};

const GoldenFile kGolden[] = {
    {"png", 0x31482b84325acfac, [](const Image& image) { return encode_png(image); }},
    {"png 16", 0xc66c432d6aff43e5,
     [](const Image& image) {
       const std::vector<std::uint16_t> levels = levels_16(image, Transfer::Srgb);
       return encode_png_16({image.width, image.height, 3, std::span(levels)}, Transfer::Srgb);
     }},
    {"jpeg", 0x4d9a913ea9f25cc9,
     [](const Image& image) {
       const std::vector<std::uint8_t> levels = levels_8(image);
       return encode_jpeg({image.width, image.height, 3, std::span(levels)}, 90);
     }},
    {"exr half", 0x05c00aec3fa0c909,
     [](const Image& image) {
       const ExrLayers colors = color_layers(image, ExrLayers::Storage::Half);
       return encode_exr({&colors, 1});
     }},
    {"exr float", 0x72588b1f14a26950,
     [](const Image& image) {
       const ExrLayers colors = color_layers(image, ExrLayers::Storage::Exact);
       return encode_exr({&colors, 1});
     }},
    {"pfm", 0x72588b1f14a26950, [](const Image& image) { return encode_pfm(color_plane(image)); }},
    {"exr of every plane", 0x82fe7fc24c5cdc81, exr_of_planes},
    {"png of normals", 0x4aebd6136efbfd88,
     [](const Image& image) { return encode_png(plane_picture(image, Plane::Normal)); }},
    {"png of depths", 0x2d252b5e353e8308,
     [](const Image& image) { return encode_png(plane_picture(image, Plane::Depth)); }},
};

TEST(GoldenFiles, OfEachFormatHoldTheSameNumbersOnEveryTarget) {
  const GeneratedScene made = generate_scene("typewriter");
  const Scene scene(made.mesh);
  const View view{made.camera_position, made.look_at, made.up, made.field_angle_deg * M_PI / 180};
  std::vector<Light> lights;
  for (const auto& light : made.lights) lights.push_back({light.position, Color{1, 0.75f, 0.5f}, light.intensity});
  Renderer::Options options;
  options.width = options.height = 64;
  for (const Plane plane : all_planes()) options.planes.add(plane);
  const simd::Target before = simd::active_target();
  for (const simd::Target target : simd::supported_targets()) {
    simd::set_active_target(target);
    const Image image = Renderer(scene, view, lights, options).render();
    for (const GoldenFile& file : kGolden) {
      EXPECT_EQ(hash_of_file(file.encode(image)), file.hash) << file.name << " " << simd::name_of(target);
    }
  }
  simd::set_active_target(before);
}

}  // namespace
