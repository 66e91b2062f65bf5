#pragma once

#include <facemap/mesh.h>

#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <string>
#include <vector>

namespace facemap {

/// An image that a model names, not decoded: a file, or the bytes of one that was embedded.
struct TextureImage {
  std::string name;                 ///< as the model has it, for messages
  std::filesystem::path file;       ///< where to read it; empty: `bytes`
  std::vector<std::uint8_t> bytes;  ///< a PNG or JPEG file's
};

/// How a material uses an image. A corner's texture coordinates (u, v) name the place offset + R(rotation) (scale *
/// (u, v)) of it, where R turns u towards v.
struct TextureUse {
  enum class Wrap { Repeat, Mirror, Clamp };

  std::uint32_t image = kNoIndex;  ///< into Model::images; kNoIndex: none
  bool is_v_down = false;          ///< (0, 0) is the image's upper left corner (glTF), not its lower left (OBJ)
  Wrap wrap_u = Wrap::Repeat, wrap_v = Wrap::Repeat;
  glm::vec2 offset{0}, scale{1};
  float rotation = 0;        ///< radians
  float base = 0, gain = 1;  ///< a value x of the image counts as base + gain x
  float strength = 1;        ///< of a bump or normal map
  int channel = -1;          ///< 0..3, where one channel is asked for; -1: the usual one
  bool is_smooth = true;     ///< filtered between texels when enlarged

  bool is_used() const noexcept { return image != kNoIndex; }
};

}  // namespace facemap
