#pragma once

#include <facemap/renderer.h>

#include <cstdint>
#include <span>
#include <vector>

#include "material/material_table.h"
#include "parallel/executor.h"
#include "picture/sample_grid.h"
#include "render/joined_faces.h"
#include "render/picture_pieces.h"

namespace facemap {

/// The lights that add to what some samples see.
struct SampleLights {
  std::span<const std::uint32_t> samples;
  std::span<const std::uint8_t> masks;  ///< `stride` bytes each
  std::size_t stride;

  const std::uint8_t* mask(std::size_t i) const { return masks.data() + i * stride; }
};

/// Where the samples of a band's divided pixels stand in an array of them alone: pixel by pixel, each row by row.
struct DividedPlaces {
  std::uint32_t columns, per_side;         ///< of the band's samples
  std::vector<std::uint32_t> pixels = {};  ///< those that are divided, by their numbers in the band
  std::vector<std::uint32_t> ranks = {};   ///< of all of the band's pixels among them

  std::size_t in_pixel() const { return std::size_t{per_side} * per_side; }
  std::size_t count() const { return pixels.size() * in_pixel(); }
  std::size_t place(std::uint32_t sample) const {
    const std::uint32_t row = sample / columns, column = sample % columns, n = per_side;
    return (std::size_t{ranks[row / n * (columns / n) + column / n]} * n + row % n) * n + column % n;
  }
};

/// Decides which pixels of a picture are divided into samples, from what one ray a pixel and then the samples see.
/// Wang 2022, sec. 2.3, Fig. 3: those that may hold an edge.
///
/// First, with the faces that all samples see: a pixel whose samples see faces that are not joined, or whose neighbour
/// in which that is not so either has other lights or, without textures, quite another colour. Then, in another round:
/// a pixel beside one whose samples next to it have other lights.
class EdgePixels {
 public:
  /// After the first. More find little: they follow shadows thinner than a pixel, at the price of finding the camera's
  /// faces again.
  static constexpr int kRounds = 1;

  /// Whether a pixel is divided depends on none farther away: on its neighbours' centres, and on those of the pixels
  /// that a round found it by.
  static constexpr int kReach = 1 + kRounds;

  /// All must outlive it; `materials` may be null.
  EdgePixels(const Scene& scene, const View& view, const Renderer::Options& options, const MaterialTable* materials,
             const Executor& executor);

  /// What the rays through the pixels' centres see, for a band of rows of pixels.
  void set_centres(const SampleGrid& centres, std::span<const FaceId> faces, const SampleLights& lights,
                   std::span<const Color> colors);

  /// Finds the pixels to divide first. `faces`: of all samples of a band of `rows` rows of pixels, and of one row more
  /// unless that is the picture's last. Bands come from the top.
  void find_edges(const SampleGrid& samples, int rows, std::span<const FaceId> faces);

  /// Makes kNoFace of the faces of all samples but those of this round's pixels in the first `rows` rows of pixels.
  void keep_divided(const SampleGrid& samples, int rows, std::span<FaceId> faces) const;

  /// Finds pixels for the next round beside those of this one. `faces` as keep_divided() left them.
  void spread(const SampleGrid& samples, int rows, const DividedPlaces& places, std::span<const FaceId> faces,
              const SampleLights& lights);

  /// Ends a round. False if the next one has no pixels.
  bool next_round();

  /// Of the pixels of this round in the first `rows` rows of pixels of a band.
  DividedPlaces places_of_divided(const SampleGrid& samples, int rows) const;

  /// Of this round.
  bool is_divided(std::size_t pixel) const { return (states_[pixel] & kNow) != 0; }

  /// Whether some row of pixels of [first, end) has one of this round.
  bool any_divided(int first, int end) const;

  /// The first pixel of a band, whose samples are given.
  std::size_t first_pixel(const SampleGrid& samples) const { return index(0, row_of(samples)); }
  int width() const { return width_; }
  const PicturePieces& pieces() const { return pieces_; }

 private:
  enum State : std::uint8_t {
    kEdge = 1,  // its samples see faces that are not joined
    kNow = 2,   // of this round
    kDone = 4,  // of this one or an earlier one
  };
  struct Centre {
    FaceId face = kNoFace;
    std::uint64_t lights = 0;  // equal for equal masks
  };

  bool holds_edge(const SampleGrid& samples, std::span<const FaceId> faces, int x, int y, JoinedFaces& joined) const;
  bool differs_from_neighbours(int x, int y) const;
  bool differ(std::size_t pixel, std::size_t other) const;
  void spread_from(int x, int y, const SampleGrid& samples, std::span<const FaceId> faces, const std::uint64_t* key,
                   JoinedFaces& joined);
  void meet(FaceId face, std::uint64_t lights, std::size_t pixel, JoinedFaces& joined);

  int row_of(const SampleGrid& samples) const { return samples.first_row / samples.per_side - top_; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  const MaterialTable* materials_;
  const Executor& executor_;
  const int width_, height_, top_;   // of the pixels that are made, which are counted from the first of them
  const PicturePieces pieces_;       // pixels of two of them are no neighbours
  std::vector<JoinedFaces> joined_;  // one a worker
  std::vector<Centre> centres_;
  std::vector<Color> roots_;  // square roots of the centres' colours
  std::vector<std::uint8_t> states_;
  std::vector<std::uint8_t> next_;  // 1: beside a pixel of this round that has other lights
};

}  // namespace facemap
