// The scene of the golden pictures: all numbers are exact in float32, so that no compiler makes another of it.

#include <facemap/image_file.h>

#include "support/golden.h"

namespace golden {
namespace {

using namespace facemap;

/// Red, green over blue, white.
TextureImage four_colours() {
  Image image;
  image.width = image.height = 2;
  for (const std::uint32_t rgb : {0xff0000, 0x00ff00, 0x0000ff, 0xffffff}) {
    image.pixels.push_back(Color::from_24_bit(rgb));
  }
  return {"four.png", {}, encode_png(image, 1)};
}

/// Bumps and dents, as heights, directions or whatever else a map holds.
TextureImage waves() {
  Image image;
  image.width = image.height = 16;
  for (std::uint32_t i = 0; i < 256; ++i) {
    const std::uint32_t grey = (i * i / 7 + i) % 256;
    image.pixels.push_back(Color::from_24_bit(grey << 16 | (255 - grey) << 8 | 255));
  }
  return {"waves.png", {}, encode_png(image, 1)};
}

/// A chessboard of opaque and clear texels.
TextureImage holes() {
  constexpr int kSide = 8;
  std::vector<std::uint16_t> levels;
  for (int i = 0; i < kSide * kSide; ++i) {
    const bool is_there = (i / kSide + i % kSide) % 2 == 0;
    for (const int level : {65535, 40000, 20000, is_there ? 65535 : 0}) {
      levels.push_back(static_cast<std::uint16_t>(level));
    }
  }
  return {"holes.png", {}, encode_png_16({kSide, kSide, 4, std::span<const std::uint16_t>(levels)}, Transfer::Srgb)};
}

constexpr Corners kNone{kNoIndex, kNoIndex, kNoIndex};

class Builder {
 public:
  /// The floor, 8 wide, with two repeats of the texture.
  void add_floor() {
    mesh_.positions = {{-4, -1, -4}, {4, -1, -4}, {4, -1, 4}, {-4, -1, 4}};
    mesh_.texture_coordinates = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
    for (const Corners& corners : {Corners{0, 2, 1}, Corners{0, 3, 2}}) add(corners, corners, kNone, 0);
  }

  /// A part of a paraboloid that looks along +z, with its normals.
  void add_dome() {
    constexpr std::uint32_t kSides = 4;
    const std::uint32_t first = size();
    for (std::uint32_t i = 0; i < (kSides + 1) * (kSides + 1); ++i) {
      const float x = 0.5f * static_cast<float>(i % (kSides + 1)) - 1;
      const float y = 0.5f * static_cast<float>(i / (kSides + 1)) - 1;
      mesh_.positions.emplace_back(x, y, 1.25f - x * x * 0.5f - y * y * 0.5f);
      mesh_.normals.emplace_back(x, y, 1.0f);
      mesh_.texture_coordinates.emplace_back(x, y);
    }
    for (std::uint32_t i = 0; i < kSides * kSides; ++i) {
      const std::uint32_t a = i / kSides * (kSides + 1) + i % kSides, c = a + kSides + 1;
      for (const Corners& at : {Corners{a, a + 1, c + 1}, Corners{a, c + 1, c}}) {
        add({at[0] + first, at[1] + first, at[2] + first}, {at[0] + 4, at[1] + 4, at[2] + 4}, at, 0);
      }
    }
  }

  void add_box(const Vector& middle, const Vector& half) {
    const std::uint32_t first = size();
    for (int corner = 0; corner < 8; ++corner) {
      const Vector sign(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
      mesh_.positions.push_back(middle + half * sign);
    }
    constexpr Corners kFaces[] = {{0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}, {0, 1, 5}, {0, 5, 4},
                                  {2, 6, 7}, {2, 7, 3}, {0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}};
    for (const Corners& at : kFaces) add({at[0] + first, at[1] + first, at[2] + first}, kNone, kNone, 1);
  }

  Mesh take() { return std::move(mesh_); }

 private:
  std::uint32_t size() const { return static_cast<std::uint32_t>(mesh_.positions.size()); }

  void add(const Corners& corners, const Corners& texture, const Corners& normals, std::uint32_t material) {
    mesh_.triangles.push_back(corners);
    mesh_.texture_corners.push_back(texture);
    mesh_.normal_corners.push_back(normals);
    mesh_.triangle_materials.push_back(material);
  }

  Mesh mesh_;
};

Model make_model() {
  Builder builder;
  builder.add_floor();
  builder.add_dome();
  builder.add_box({-3, -0.5f, 2.5f}, {0.75f, 0.5f, 0.25f});
  builder.add_box({2.5f, 0, -2.5f}, {0.5f, 1, 0.75f});
  builder.add_box({1.75f, 1.5f, 2}, {0.25f, 0.125f, 0.5f});
  Model model;
  model.mesh = builder.take();
  Material white, grey;
  white.diffuse = Vector(1);
  grey.diffuse = {0.5f, 0.5f, 0.75f};
  model.materials = {white, grey};
  model.images = {four_colours(), waves(), holes()};
  model.objects = {"floor", "dome", "boxes"};
  for (std::size_t face = 0; face < model.mesh.face_count(); ++face) {
    model.triangle_objects.push_back(face < 2 ? 0 : face < 34 ? 1 : 2);
  }
  return model;
}

}  // namespace

Subject make_subject() {
  Subject subject;
  subject.model = make_model();
  subject.view.position = {2, 2, 6};
  subject.view.look_at = {0, 0, 0};
  subject.lights = {{{3, 4, 5}, {1, 0.75f, 0.5f}, 0.75f}, {{-4, 2, 3}, {0.5f, 0.75f, 1}, 0.5f}};
  subject.options.width = subject.options.height = 64;
  subject.options.sky_up = {0.125f, 0.125f, 0.25f};
  for (const Plane plane : all_planes()) subject.options.planes.add(plane);
  return subject;
}

}  // namespace golden
