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
inline constexpr std::uint32_t kCloseUlps = 1024;

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

/// Samples stand in blocks of 4 x 4, row by row in each, so that a small face has few cache lines to itself; blocks
/// stand row by row.
inline constexpr int kBlockSide = 4;
inline constexpr std::uint32_t kBlockSamples = kBlockSide * kBlockSide;

/// The number of a sample in a raster whose rows of blocks are `row_samples` samples apart.
inline std::uint32_t sample_at(std::uint32_t row_samples, int column, int row) {
  const auto x = static_cast<std::uint32_t>(column), y = static_cast<std::uint32_t>(row);
  return y / kBlockSide * row_samples + x / kBlockSide * kBlockSamples + y % kBlockSide * kBlockSide + x % kBlockSide;
}

/// Where it stands.
inline int column_of(std::uint32_t row_samples, std::uint32_t sample) {
  return static_cast<int>(sample % row_samples / kBlockSamples * kBlockSide + sample % kBlockSide);
}
inline int row_of(std::uint32_t row_samples, std::uint32_t sample) {
  return static_cast<int>(sample / row_samples * kBlockSide + sample % kBlockSamples / kBlockSide);
}

/// Fragments of faces that surely cover their samples, of sharp w: they wait until they are many, which spares loops of
/// few turns that are hard to predict.
struct Fragments {
  static constexpr std::size_t kRoom = 512;

  float w[kRoom];
  std::int32_t faces[kRoom];
  std::int32_t samples[kRoom];
  std::size_t count = 0;
};

/// The samples' raster, in blocks from an aligned address on. Kernels write only to samples of the boxes they are
/// given, and only to blocks that have some within its rows; these belong to one thread.
struct RasterTarget {
  float* w;                          ///< inverse depth of the face in front (one fixed unit), 0: none
  std::int32_t* faces;               ///< its id; of no meaning where there is none
  std::uint32_t row_samples;         ///< from one row of blocks to the next; all of the raster is below 2^32
  std::int32_t first_row, last_row;  ///< boxes are drawn within these rows
  Contests* contests;
  Fragments* fragments;  ///< none may be left when the raster is read: see draw_waiting
};

/// The face surely covers the sample and its w is sharp: the greater w stays. Of two that are close the smaller one is
/// contested. Whatever the order of calls, so is in the end every face that is close to the one that stays.
inline void draw_sample(const RasterTarget& target, std::uint32_t sample, float w, std::int32_t face) {
  // Floats that are not negative are ordered as their bits. No branch: which face is in front is hard to predict.
  const auto bits = std::bit_cast<std::int32_t>(w), old_bits = std::bit_cast<std::int32_t>(target.w[sample]);
  const std::int32_t old_face = target.faces[sample];
  const std::int32_t behind = old_bits - bits, is_front = behind >> 31;  // all bits or none
  target.w[sample] = std::bit_cast<float>(old_bits - (behind & is_front));
  target.faces[sample] = old_face ^ ((old_face ^ face) & is_front);
  if (static_cast<std::uint32_t>(behind) + kCloseUlps > 2 * kCloseUlps || old_bits == 0) [[likely]]
    return;
  const std::int32_t loser = old_face ^ face ^ target.faces[sample], loser_bits = is_front ? old_bits : bits;
  add_contest(*target.contests,
              {sample, static_cast<std::uint32_t>(loser), std::bit_cast<float>(loser_bits) * (1 + kSharpShare)});
}

/// The face may cover the sample, or surely does at a depth that is not sharp; contested unless surely behind.
inline void draw_unsure(const RasterTarget& target, const Contest& contest) {
  if (contest.largest_w < target.w[contest.sample] * kSurelyBehind) return;
  add_contest(*target.contests, contest);
}

}  // namespace facemap::simd
