#include <facemap/compare.h>
#include <facemap/image_file.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <cmath>
#include <filesystem>

#include "support/planes.h"

namespace {

using namespace facemap;
namespace fs = std::filesystem;

/// Two pixels: one sees something, the other does not.
Image two_pixels() {
  constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
  Image image;
  image.width = 2;
  image.height = 1;
  image.pixels = {{1, 0.5f, 70000}, {0, 0, 0}};
  image.ids = {7, -1};
  image.depths = {2.5f, INFINITY};
  image.zs = {-1.5f, INFINITY};
  image.positions = {{1, 2, 3}, Vector(kNaN)};
  image.normals = {{0, 1, 0}, Vector(0)};
  image.face_normals = {{0, 0, -1}, Vector(0)};
  image.albedos = {{1, 0, 0.25f}, {0, 0, 0}};
  image.uvs = {{1.25f, -0.25f}, glm::vec2(kNaN)};
  image.objects = {0, -1};
  image.materials = {-1, -1};
  image.light_count = 9;
  image.lights = {255, 0, 0, 0};
  image.shadows = {1, -1};
  return image;
}

/// The channels of a file of these bytes, by name.
PictureChannels read_back(std::span<const std::uint8_t> bytes) {
  std::string name = (fs::temp_directory_path() / "facemap-planes-XXXXXX").string();
  const fs::path folder = mkdtemp(name.data());
  write_file(folder / "file", bytes);
  const PictureChannels picture = read_picture(folder / "file");
  fs::remove_all(folder);
  return picture;
}

std::string names_of(const PictureChannels& picture) {
  std::string names;
  for (const auto& channel : picture.channels) names += channel.name + " ";
  return names;
}

template <class Value>
std::vector<Value> values_of(const PictureChannels& picture, const std::string& name) {
  for (const auto& channel : picture.channels) {
    if (channel.name == name) return std::get<std::vector<Value>>(channel.values);
  }
  ADD_FAILURE() << "no channel " << name;
  return {};
}

TEST(PlaneFiles, AnExrFileHoldsEveryPlaneAsALayer) {
  const Image image = two_pixels();
  std::vector<ExrLayers> layers = {color_layers(image, ExrLayers::Storage::Half)};
  for (const Plane plane : all_planes()) layers.push_back(plane_layers(image, plane));
  const PictureChannels file = read_back(encode_exr(layers));
  EXPECT_EQ(names_of(file),
            "B G N.X N.Y N.Z Ng.X Ng.Y Ng.Z P.X P.Y P.Z R UV.U UV.V Z albedo.B albedo.G albedo.R face.id lights.0 "
            "lights.1 material.id object.id range.Z shadows.count ");
  EXPECT_EQ(values_of<float>(file, "B"), (std::vector<float>{65504, 0})) << "the largest half";
  EXPECT_EQ(values_of<float>(file, "range.Z"), image.depths);
  EXPECT_EQ(values_of<float>(file, "Z"), image.zs);
  EXPECT_EQ(values_of<float>(file, "N.Y"), (std::vector<float>{1, 0}));
  EXPECT_EQ(values_of<float>(file, "Ng.Z"), (std::vector<float>{-1, 0}));
  EXPECT_EQ(values_of<float>(file, "UV.V")[0], -0.25f);
  EXPECT_TRUE(std::isnan(values_of<float>(file, "P.X")[1]));
  EXPECT_EQ(values_of<std::uint32_t>(file, "face.id"), (std::vector<std::uint32_t>{7, 0xffffffff}));
  EXPECT_EQ(values_of<std::uint32_t>(file, "lights.0"), (std::vector<std::uint32_t>{255, 0}));
  EXPECT_EQ(values_of<std::uint32_t>(file, "shadows.count"), (std::vector<std::uint32_t>{1, 0xffffffff}));
}

TEST(PlaneFiles, APfmFileHoldsPlanesOfOneOrThreeFloats) {
  const Image image = two_pixels();
  EXPECT_EQ(values_of<float>(read_back(encode_pfm(plane_view(image, Plane::Z))), "Y"), image.zs);
  const PictureChannels position = read_back(encode_pfm(plane_view(image, Plane::Position)));
  EXPECT_EQ(values_of<float>(position, "G")[0], 2);
  EXPECT_EQ(error_of([&] { encode_pfm(plane_view(image, Plane::Uv)); }), "PFM: the format has no 2 channels");
}

TEST(PlaneFiles, PicturesOfPlanesAreForTheEye) {
  const Image image = two_pixels();
  const auto first = [&](Plane plane) { return plane_picture(image, plane).pixels[0].to_24_bit(); };
  EXPECT_EQ(first(Plane::Depth), 0xffffffu) << "the nearest";
  EXPECT_EQ(first(Plane::Normal), 0x80ff80u);
  EXPECT_EQ(first(Plane::FaceNormal), 0x808000u);
  EXPECT_EQ(first(Plane::Albedo), 0xff0089u) << "sRGB";
  EXPECT_EQ(first(Plane::Uv), 0x40bf00u) << "what follows the point";
  EXPECT_EQ(first(Plane::Material), 0u) << "it has none";
  EXPECT_EQ(first(Plane::Lights), 0xe3e3e3u) << "8 of 9";
  EXPECT_EQ(first(Plane::Shadows), 0x1c1c1cu) << "1 of 9";
  EXPECT_NE(first(Plane::Id), first(Plane::Object)) << "different numbers";
  for (const Plane plane : all_planes()) {
    EXPECT_EQ(plane_picture(image, plane).pixels[1].to_24_bit(), 0u) << name_of(plane) << ": no face is black";
    EXPECT_EQ(plane_picture(image, plane).width, 2);
  }
}

TEST(PlaneFiles, AnImageWithoutThePlaneIsRefused) {
  Image image = two_pixels();
  image.uvs.clear();
  EXPECT_EQ(error_of([&] { plane_view(image, Plane::Uv); }), "the image has no plane of uv");
  EXPECT_EQ(error_of([&] { plane_picture(image, Plane::Uv); }), "the image has no plane of uv");
  EXPECT_EQ(error_of([&] { plane_layers(image, Plane::Uv); }), "the image has no plane of uv");
}

}  // namespace
