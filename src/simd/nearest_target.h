#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

/// What the camera's raster writes: for each sample the face in front so far, and the few (sample, face) pairs that
/// float32 leaves open.
namespace facemap::simd {

/// Faces are prepared and drawn this many at a time, whatever the target's lanes.
inline constexpr std::size_t kBlockFaces = 16;

/// Inverse depths w are `sharp` if known to a share of 2^-16. Two sharp ones whose bits, read as integers, are more
/// than this apart differ by a share of 2^-14 at least: their order is certain.
inline constexpr std::int32_t kCloseUlps = 1024;

/// A sharp w may be too large by this factor, and twice more for what is compared with it.
inline constexpr float kSurelyBehind = 1 - 0x1p-15f;

/// The largest share by which a sharp w may be too small, rounding included.
inline constexpr float kSharpShare = 0x1p-15f;

/// A pair left open: the face may be what the sample sees.
struct Contest {
  std::uint32_t sample;
  std::uint32_t face;  ///< with kUnsureCover if the ray may miss it
  float largest_w;     ///< upper bound of the face's inverse depth there

  static constexpr std::uint32_t kUnsureCover = 0x80000000u;
};

using Contests = std::vector<Contest>;

/// Out of line, so that no kernel's instruction set reaches the vector's code.
void add_contest(Contests& contests, const Contest& contest);

/// A box of samples, both ends inside.
struct SampleBox {
  std::int32_t x0, x1, y0, y1;
};

/// The samples' raster, row by row. Kernels write only to samples of the boxes they are given, and
/// only within its rows.
struct RasterTarget {
  float* w;                          ///< inverse depth of the face in front (one fixed unit), 0: none
  std::int32_t* faces;               ///< its id, -1: none
  std::uint32_t columns;             ///< samples a row; rows x columns is below 2^32
  std::int32_t first_row, last_row;  ///< boxes are drawn within these rows
  Contests* contests;
};

/// The face surely covers the sample and its w is sharp: the greater w stays. Of two that are close the smaller one is
/// contested. Whatever the order of calls, so is in the end every face that is close to the one that stays.
inline void draw_sample(const RasterTarget& target, std::uint32_t sample, float w, std::int32_t face) {
  const float old_w = target.w[sample];
  const std::int32_t old_face = target.faces[sample];
  const auto bits = std::bit_cast<std::int32_t>(w), old_bits = std::bit_cast<std::int32_t>(old_w);
  const bool is_front = w > old_w;
  // No branch: which of two faces is in front is hard to predict.
  const std::int32_t change = -static_cast<std::int32_t>(is_front);
  target.w[sample] = std::bit_cast<float>(old_bits ^ ((old_bits ^ bits) & change));
  target.faces[sample] = old_face ^ ((old_face ^ face) & change);
  const std::int32_t apart = bits - old_bits;
  if (apart > kCloseUlps || apart < -kCloseUlps || old_face < 0) [[likely]]
    return;
  const auto loser = static_cast<std::uint32_t>(is_front ? old_face : face);
  add_contest(*target.contests, {sample, loser, (is_front ? old_w : w) * (1 + kSharpShare)});
}

/// The face may cover the sample, or surely does at a depth that is not sharp; contested unless surely behind.
inline void draw_unsure(const RasterTarget& target, const Contest& contest) {
  if (contest.largest_w < target.w[contest.sample] * kSurelyBehind) return;
  add_contest(*target.contests, contest);
}

}  // namespace facemap::simd
