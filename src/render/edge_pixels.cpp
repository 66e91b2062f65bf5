#include "render/edge_pixels.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>

#include "render/picture_frame.h"

namespace facemap {
namespace {

// Of square roots of colours, which are about as even to the eye as levels of sRGB: 16 levels of 255.
constexpr float kContrast = 16.0f / 255;

// Masks of up to 64 lights are told apart; of more, as well as 64 bits can. splitmix64's mixing (Steele, Lea, Flood
// 2014).
std::uint64_t key_of(const std::uint8_t* mask, std::size_t stride) {
  std::uint64_t key = 0;
  for (std::size_t first = 0; first < stride; first += sizeof(key)) {
    std::uint64_t word = 0;
    std::memcpy(&word, mask + first, std::min(sizeof(word), stride - first));
    if (first > 0) {
      key = (key ^ (key >> 30)) * 0xbf58476d1ce4e5b9u;
      key = (key ^ (key >> 27)) * 0x94d049bb133111ebu;
      key ^= key >> 31;
    }
    key += word;
  }
  return key;
}

Color root_of(const Color& c) { return {std::sqrt(c.r), std::sqrt(c.g), std::sqrt(c.b)}; }

}  // namespace

EdgePixels::EdgePixels(const Scene& scene, const View& view, const Renderer::Options& options,
                       const MaterialTable* materials, const Executor& executor)
    : materials_(materials),
      executor_(executor),
      width_(made_pixels(options).width),
      height_(made_pixels(options).height),
      top_(made_pixels(options).y),
      pieces_(PicturePieces::of(view, made_pixels(options))) {
  for (int i = 0; i < executor.threads(); ++i) {
    joined_.emplace_back(scene, view.position, options.normals, materials);
  }
  const std::size_t pixels = static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_);
  centres_.resize(pixels);
  roots_.resize(pixels);
  states_.resize(pixels);
  next_.resize(pixels);
}

void EdgePixels::set_centres(const SampleGrid& centres, std::span<const FaceId> faces, const SampleLights& lights,
                             std::span<const Color> colors) {
  const std::size_t first = first_pixel(centres);
  for (std::size_t i = 0; i < faces.size(); ++i) {
    centres_[first + i].face = faces[i];
    roots_[first + i] = root_of(colors[i]);
  }
  for (std::size_t i = 0; i < lights.samples.size(); ++i) {
    centres_[first + lights.samples[i]].lights = key_of(lights.mask(i), lights.stride);
  }
}

void EdgePixels::find_edges(const SampleGrid& samples, int rows, std::span<const FaceId> faces) {
  const int top = row_of(samples), all = samples.rows() / samples.per_side;
  executor_.for_each(static_cast<std::size_t>(all), [&](std::size_t row, int worker) {
    JoinedFaces& joined = joined_[static_cast<std::size_t>(worker)];
    const int y = top + static_cast<int>(row);
    for (int x = 0; x < width_; ++x) {
      if (holds_edge(samples, faces, x, y, joined)) states_[index(x, y)] |= kEdge;
    }
  });
  std::vector<std::uint8_t> divided(static_cast<std::size_t>(rows) * static_cast<std::size_t>(width_));
  executor_.for_each(static_cast<std::size_t>(rows), [&](std::size_t row, int) {
    const int y = top + static_cast<int>(row);
    for (int x = 0; x < width_; ++x) {
      divided[index(x, y) - index(0, top)] = (states_[index(x, y)] & kEdge) != 0 || differs_from_neighbours(x, y);
    }
  });
  for (std::size_t i = 0; i < divided.size(); ++i) {
    if (divided[i]) states_[index(0, top) + i] |= kNow | kDone;
  }
}

// Neighbours among the samples are compared, and the centre with the sample after it.
bool EdgePixels::holds_edge(const SampleGrid& samples, std::span<const FaceId> faces, int x, int y,
                            JoinedFaces& joined) const {
  const auto columns = static_cast<std::size_t>(samples.columns()), n = static_cast<std::size_t>(samples.per_side);
  const FaceId centre = centres_[index(x, y)].face;
  const auto row = static_cast<std::size_t>(y - row_of(samples));
  const FaceId* const first = &faces[row * n * columns + static_cast<std::size_t>(x) * n];
  bool are_equal = true;
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) are_equal &= first[j * columns + i] == centre;
  }
  if (are_equal) return false;
  if (!joined.are_joined(centre, first[n / 2 * columns + n / 2])) return true;
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      const FaceId* const at = first + j * columns + i;
      if (i + 1 < n && !joined.are_joined(at[0], at[1])) return true;
      if (j + 1 < n && !joined.are_joined(at[0], at[columns])) return true;
    }
  }
  return false;
}

bool EdgePixels::differs_from_neighbours(int x, int y) const {
  for (int v = std::max(0, y - 1); v <= std::min(height_ - 1, y + 1); ++v) {
    for (int u = std::max(0, x - 1); u <= std::min(width_ - 1, x + 1); ++u) {
      if (pieces_.are_one(x, y, u, v) && differ(index(x, y), index(u, v))) return true;
    }
  }
  return false;
}

// Of pixels without an edge between faces.
bool EdgePixels::differ(std::size_t pixel, std::size_t other) const {
  const Centre &a = centres_[pixel], &b = centres_[other];
  if (a.face == kNoFace || b.face == kNoFace || ((states_[pixel] | states_[other]) & kEdge) != 0) return false;
  if (a.lights != b.lights) return true;
  if (materials_ != nullptr && (materials_->has_textures(static_cast<std::uint32_t>(a.face)) ||
                                materials_->has_textures(static_cast<std::uint32_t>(b.face)))) {
    return false;  // textures are filtered
  }
  const Color difference = roots_[pixel] - roots_[other];
  return std::max({std::abs(difference.r), std::abs(difference.g), std::abs(difference.b)}) > kContrast;
}

void EdgePixels::keep_divided(const SampleGrid& samples, int rows, std::span<FaceId> faces) const {
  const auto columns = static_cast<std::size_t>(samples.columns()), n = static_cast<std::size_t>(samples.per_side);
  const std::size_t first = first_pixel(samples);
  executor_.for_each(static_cast<std::size_t>(samples.rows()), [&](std::size_t row, int) {
    FaceId* const of_row = &faces[row * columns];
    const std::size_t y = row / n;
    for (std::size_t x = 0; x < static_cast<std::size_t>(width_); ++x) {
      const bool is_kept =
          y < static_cast<std::size_t>(rows) && is_divided(first + y * static_cast<std::size_t>(width_) + x);
      if (!is_kept) std::fill_n(of_row + x * n, n, kNoFace);
    }
  });
}

DividedPlaces EdgePixels::places_of_divided(const SampleGrid& samples, int rows) const {
  DividedPlaces places{static_cast<std::uint32_t>(samples.columns()), static_cast<std::uint32_t>(samples.per_side)};
  const std::size_t first = first_pixel(samples);
  places.ranks.resize(static_cast<std::size_t>(rows) * static_cast<std::size_t>(width_));
  for (std::size_t i = 0; i < places.ranks.size(); ++i) {
    if (!is_divided(first + i)) continue;
    places.ranks[i] = static_cast<std::uint32_t>(places.pixels.size());
    places.pixels.push_back(static_cast<std::uint32_t>(i));
  }
  return places;
}

void EdgePixels::spread(const SampleGrid& samples, int rows, const DividedPlaces& places, std::span<const FaceId> faces,
                        const SampleLights& lights) {
  std::vector<std::uint64_t> keys(places.count());
  constexpr std::size_t kLeastSamples = 1 << 14;  // of a task
  for_ranges(executor_, lights.samples.size(), kLeastSamples, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      keys[places.place(lights.samples[i])] = key_of(lights.mask(i), lights.stride);
    }
  });
  executor_.for_each(static_cast<std::size_t>(rows), [&](std::size_t row, int worker) {
    for (int x = 0; x < width_; ++x) {
      const int y = row_of(samples) + static_cast<int>(row);
      if (!is_divided(index(x, y))) continue;
      const std::size_t rank = places.ranks[index(x, static_cast<int>(row))];
      spread_from(x, y, samples, faces, &keys[rank * places.in_pixel()], joined_[static_cast<std::size_t>(worker)]);
    }
  });
}

// The samples of the pixel's border.
void EdgePixels::spread_from(int x, int y, const SampleGrid& samples, std::span<const FaceId> faces,
                             const std::uint64_t* key, JoinedFaces& joined) {
  const int n = samples.per_side, row = y - row_of(samples);
  const FaceId* const first = &faces[static_cast<std::size_t>(row * n) * static_cast<std::size_t>(samples.columns()) +
                                     static_cast<std::size_t>(x * n)];
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i, ++key) {
      const FaceId face = first[static_cast<std::size_t>(j) * static_cast<std::size_t>(samples.columns()) +
                                static_cast<std::size_t>(i)];
      if (face == kNoFace) continue;
      for (int v = y - (j == 0); v <= y + (j == n - 1); ++v) {
        for (int u = x - (i == 0); u <= x + (i == n - 1); ++u) {
          const bool is_made = u >= 0 && v >= 0 && u < width_ && v < height_;
          if (is_made && pieces_.are_one(x, y, u, v)) meet(face, *key, index(u, v), joined);
        }
      }
    }
  }
}

// A sample next to a pixel.
void EdgePixels::meet(FaceId face, std::uint64_t lights, std::size_t pixel, JoinedFaces& joined) {
  const Centre& centre = centres_[pixel];
  if (centre.face == kNoFace || centre.lights == lights || (states_[pixel] & kDone) != 0) return;
  if (joined.are_joined(face, centre.face)) std::atomic_ref(next_[pixel]).store(1, std::memory_order_relaxed);
}

bool EdgePixels::next_round() {
  bool any = false;
  for (std::size_t i = 0; i < states_.size(); ++i) {
    // A later band of this round may have divided it.
    const bool is_next = next_[i] != 0 && (states_[i] & kDone) == 0;
    states_[i] = static_cast<std::uint8_t>((states_[i] & (kEdge | kDone)) | (is_next ? kNow | kDone : 0));
    any = any || is_next;
    next_[i] = 0;
  }
  return any;
}

bool EdgePixels::any_divided(int first, int end) const {
  return std::any_of(states_.begin() + static_cast<std::ptrdiff_t>(index(0, first)),
                     states_.begin() + static_cast<std::ptrdiff_t>(index(0, end)),
                     [](std::uint8_t state) { return (state & kNow) != 0; });
}

}  // namespace facemap
