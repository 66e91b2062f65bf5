#include "render/whole_picture.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "picture/cut_out_faces.h"
#include "picture/cut_out_shadows.h"
#include "picture/hidden_points.h"
#include "picture/lit_points.h"
#include "picture/moved_points.h"
#include "picture/nearest_faces.h"
#include "picture/sample_grid.h"
#include "picture/seen_points.h"
#include "render/filtered_rows.h"
#include "render/picture_frame.h"
#include "render/shade_picture.h"
#include "render/stopwatch.h"

namespace facemap {
namespace {

// Bytes that a sample may take while its band is worked on: the camera's raster, its point, and its place about a light
// in each thread. There it is listed (16), has a texel and a rank (8), a record (16) and its number (4), and the raster
// has up to one texel (4) and that one's spots (4) for it. For sizing bands by Options::map_memory; no bound.
constexpr std::size_t kBytesPerSample = 40, kBytesPerSampleAndThread = 52;
constexpr std::size_t kBytesPerFaceAndThread = 12;

constexpr int kFewestRows = 16;  // of a band, unless the picture has fewer

// Masks of points, put where their samples lie.
void put_masks(const SeenPoints& seen, std::uint8_t* masks) {
  const std::size_t stride = seen.stride;
  const UnsetVector<std::uint32_t>& numbers = seen.points.samples;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    for (std::size_t k = 0; k < stride; ++k) masks[numbers[i] * stride + k] = seen.masks[i * stride + k];
  }
}

// Puts what belongs to a band into the plane of the whole picture, or takes it as the whole.
template <class T>
void put_band(std::vector<T>&& band, std::size_t first, std::size_t count, std::vector<T>& plane) {
  if (band.size() == count) {
    plane = std::move(band);
    return;
  }
  plane.resize(count);
  std::copy(band.begin(), band.end(), plane.begin() + static_cast<std::ptrdiff_t>(first));
}

// The lights that reach some of the points.
std::vector<std::uint8_t> any_of_masks(const SeenPoints& seen) {
  std::vector<std::uint8_t> any(seen.stride);
  for (std::size_t i = 0; i < seen.masks.size(); ++i) any[i % seen.stride] |= seen.masks[i];
  return any;
}

std::size_t count_bits(const std::vector<std::uint8_t>& bytes) {
  std::size_t count = 0, i = 0;
  for (std::uint64_t word; i + sizeof(word) <= bytes.size(); i += sizeof(word)) {
    std::memcpy(&word, &bytes[i], sizeof(word));
    count += static_cast<unsigned>(std::popcount(word));
  }
  for (; i < bytes.size(); ++i) count += static_cast<unsigned>(std::popcount(bytes[i]));
  return count;
}

// The mean of each pixel's samples, in the order of rows and columns.
std::vector<Color> mean_of_samples(const SampleGrid& grid, const std::vector<Color>& colors, const Executor& executor) {
  const auto per_side = static_cast<std::size_t>(grid.per_side);
  const std::size_t width = static_cast<std::size_t>(grid.columns()) / per_side;
  const std::size_t height = static_cast<std::size_t>(grid.rows()) / per_side;
  const double count = static_cast<double>(per_side * per_side);
  std::vector<Color> means(width * height);
  executor.for_each(height, [&](std::size_t y, int) {
    for (std::size_t x = 0; x < width; ++x) {
      double r = 0, g = 0, b = 0;
      for (std::size_t j = 0; j < per_side; ++j) {
        const Color* row = &colors[((y * per_side + j) * width + x) * per_side];
        for (std::size_t i = 0; i < per_side; ++i) {
          r += row[i].r;
          g += row[i].g;
          b += row[i].b;
        }
      }
      means[y * width + x] = {static_cast<float>(r / count), static_cast<float>(g / count),
                              static_cast<float>(b / count)};
    }
  });
  return means;
}

}  // namespace

WholePicture::WholePicture(const Scene& scene, const std::shared_ptr<const CutOuts>& cut_outs, const View& view,
                           const std::vector<Light>& lights, const Renderer::Options& options, const Executor& executor,
                           TransposedState& state, const ListsOfLights& lists, bool asks_lists, bool keeps_bounds,
                           const MaterialTable* materials, Renderer::Statistics& statistics, Report report)
    : scene_(scene),
      cut_outs_(cut_outs),
      solid_(cut_outs != nullptr ? cut_outs->solid() : scene),
      shown_(cut_outs != nullptr ? cut_outs->shown() : scene),
      view_(view),
      lights_(lights),
      options_(options),
      executor_(executor),
      state_(state),
      places_(LightPlaces::of(lights)),
      lists_(lights.size()),
      transposes_(!asks_lists && places_.any_has_a_place()),
      keeps_bounds_(keeps_bounds),
      materials_(materials),
      statistics_(statistics),
      report_(std::move(report)) {
  state_.scratch.resize(static_cast<std::size_t>(executor.threads()));
  for (std::size_t l = 0; l < lists_.size(); ++l) {
    if (asks_lists || places_.is_parallel[l] != 0) lists_[l] = lists[l].get();
  }
}

// Whole pixels stay together.
std::vector<SampleGrid> WholePicture::bands(int per_side, std::size_t largest) const {
  SampleGrid grid = grid_of(view_, options_, per_side);
  if (options_.map_memory != 0) {
    const auto threads = static_cast<std::size_t>(executor_.threads());
    const std::size_t for_faces = scene_.mesh().positions.size() * kBytesPerFaceAndThread * threads;
    const std::size_t left = options_.map_memory - std::min(options_.map_memory, for_faces);
    const std::size_t of_table = grid.lens.projection() == nullptr ? DirectionTable::kBytesPerSample : 0;
    largest = std::min(largest, left / (kBytesPerSample + of_table + kBytesPerSampleAndThread * threads));
  }
  const int all = grid.rows(), end = grid.first_row + all;
  const auto fitting = static_cast<int>(
      std::min<std::size_t>(largest / static_cast<std::size_t>(grid.columns()), static_cast<std::size_t>(all)));
  const int rows = std::max(fitting / per_side, (kFewestRows + per_side - 1) / per_side) * per_side;
  std::vector<SampleGrid> result;
  for (; grid.first_row < end; grid.first_row += rows) {
    grid.row_count = std::min(rows, end - grid.first_row);
    result.push_back(grid);
  }
  return result;
}

// The table of what kernels do not give.
SampleGrid WholePicture::with_directions(SampleGrid band) {
  const Stopwatch time;
  if (band.lens.projection() == nullptr) band.directions = make_directions(band, executor_);
  statistics_.camera_map_ms += time.milliseconds();
  return band;
}

// In the image of the grid's samples.
std::size_t WholePicture::first_row_of(const SampleGrid& grid) const {
  return static_cast<std::size_t>(grid.first_row - made_pixels(options_).y * grid.per_side);
}

void WholePicture::report(double share, const char* phase) {
  report_((static_cast<double>(bands_done_) + share) / static_cast<double>(band_count_), phase);
}

NearestFaces WholePicture::nearest_faces(const SampleGrid& grid) {
  const Stopwatch camera_time;
  report(0, "camera map");
  NearestFaces nearest = find_nearest_faces(solid_, grid, executor_, &statistics_.camera_tests);
  if (has_holes()) add_cut_outs(scene_, cut_outs_, grid, executor_, nearest, &statistics_.camera_tests);
  statistics_.camera_queries += grid.count();
  statistics_.camera_map_ms += camera_time.milliseconds();
  return nearest;
}

WholePicture::Seen WholePicture::see(const SampleGrid& grid, NearestFaces nearest) {
  const Stopwatch camera_time;
  SeenPoints seen = find_seen_points(shown_, grid, nearest, places_, executor_);
  statistics_.camera_map_ms += camera_time.milliseconds();
  ask_lights(grid, seen);
  return {grid, std::move(nearest.faces), std::move(seen)};
}

// What the first light of a scene needs, what moved points do if there are closed parts, and fresh memory for the
// colours: by tasks of their own.
void WholePicture::prepare_lights(const SampleGrid& grid, const MovedPoints& moved, SeenPoints& seen) {
  const auto make_closed = [&] { state_.closed = std::make_unique<ClosedParts>(solid_, executor_); };
  // Several threads find both without waiting to know whether there are closed parts at all.
  if (executor_.threads() == 1 && state_.closed == nullptr) make_closed();
  const bool makes_closed = state_.closed == nullptr;
  const bool finds_hidden = !moved.numbers.empty() && (makes_closed || state_.closed->any());
  std::vector<std::uint32_t> hidden;
  Counters counters;
  executor_.for_each(3, [&](std::size_t task, int worker) {
    if (task == 0 && finds_hidden) {
      hidden = find_hidden_points(solid_, grid.frame.position(), seen.points, moved,
                                  state_.scratch[static_cast<std::size_t>(worker)], counters);
    }
    if (task == 1 && makes_closed) make_closed();
    if (task == 2 && paints_) colors_.assign(grid.count(), options_.background);
  });
  if (state_.closed->any()) {
    statistics_.camera_tests += counters;
    std::vector<std::uint32_t> loose(seen.loose.size() + hidden.size());
    std::merge(seen.loose.begin(), seen.loose.end(), hidden.begin(), hidden.end(), loose.begin());
    loose.erase(std::unique(loose.begin(), loose.end()), loose.end());
    seen.loose = std::move(loose);
  }
  if (keeps_bounds_ && !state_.bounds.are_made() && !lights_.empty()) {
    state_.bounds.make(solid_, places_, state_.closed.get(), state_.closed->outside(solid_, grid.frame.position()),
                       executor_);
  }
}

// Of directional lights whose lists are not kept: those of few lights at a time.
void WholePicture::ask_passing_lists(const SampleGrid& grid, const MovedPoints& moved, SeenPoints& seen) {
  std::vector<std::size_t> missing;
  for (std::size_t l = 0; l < lists_.size(); ++l) {
    if (places_.is_parallel[l] != 0 && lists_[l] == nullptr) missing.push_back(l);
  }
  if (missing.empty()) return;
  const std::vector<std::uint8_t> asked = any_of_masks(seen);
  const auto is_asked = [&](std::size_t l) { return ((asked[l / 8] >> (l % 8)) & 1) != 0; };
  missing.erase(std::partition(missing.begin(), missing.end(), is_asked), missing.end());
  PointLight::Options wanted;
  wanted.cut_outs = options_.materials;
  wanted.max_texture_pixels = options_.max_texture_pixels;
  const auto together = static_cast<std::size_t>(executor_.threads());
  for (std::size_t first = 0; first < missing.size(); first += together) {
    ListsOfLights passing(std::min(together, missing.size() - first));
    executor_.for_each(passing.size(), [&](std::size_t i, int) {
      passing[i] = std::make_unique<LightLists>(scene_, lights_[missing[first + i]], wanted);
    });
    std::vector<const LightLists*> of_lights(lists_.size());
    for (std::size_t i = 0; i < passing.size(); ++i) of_lights[missing[first + i]] = passing[i].get();
    clear_blocked_by_lists(of_lights, scene_, grid, executor_, moved, seen, statistics_.light_tests);
  }
}

void WholePicture::ask_lights(const SampleGrid& grid, SeenPoints& seen) {
  report(0.2, "light maps");
  const Stopwatch moved_time;
  const MovedPoints moved = find_moved_points(scene_, grid, seen, lights_, options_, executor_);
  clear_unreached(scene_, grid, seen, lights_, executor_);
  put_in_place(moved, executor_, seen.points);
  statistics_.light_queries += count_bits(seen.masks);
  statistics_.shade_ms += moved_time.milliseconds();
  const Stopwatch closed_time;
  if (transposes_) prepare_lights(grid, moved, seen);
  statistics_.light_maps_ms += closed_time.milliseconds();

  report(0.3, "shade");
  const Stopwatch light_time;
  if (std::any_of(lists_.begin(), lists_.end(), [](const LightLists* lists) { return lists != nullptr; })) {
    clear_blocked_by_lists(lists_, scene_, grid, executor_, moved, seen, statistics_.light_tests);
  }
  ask_passing_lists(grid, moved, seen);
  if (transposes_) {
    const LightWork work{
        solid_, places_, state_.closed.get(), &state_.bounds, executor_, state_.scratch, [this](double share) {
          report(0.3 + 0.5 * share, "shade");
        }};
    clear_blocked(work, grid, moved, seen, statistics_.light_tests);
    if (has_holes()) {
      KeptCutOutLists* const kept = options_.map_memory == 0 ? &state_.cut_outs : nullptr;
      clear_blocked_by_cut_outs(scene_, cut_outs_, places_, grid, executor_, moved, kept, seen,
                                statistics_.light_tests);
    }
  }
  give_back(moved, seen);
  statistics_.shade_ms += light_time.milliseconds();
}

Image WholePicture::empty_image(int per_side) const {
  Image image;
  const PixelBox pixels = made_pixels(options_);
  image.width = pixels.width * per_side;
  image.height = pixels.height * per_side;
  image.light_count = static_cast<int>(lights_.size());
  return image;
}

// The planes that are wanted of what a band sees.
void WholePicture::put_planes(Seen&& seen, Image& image) const {
  const std::size_t columns = static_cast<std::size_t>(image.width);
  const std::size_t count = columns * static_cast<std::size_t>(image.height);
  const std::size_t first = columns * first_row_of(seen.grid);
  if (options_.planes.has(Plane::Lights)) {
    image.lights.resize(count * seen.points.stride);
    put_masks(seen.points, image.lights.data() + first * seen.points.stride);
  }
  seen.points = {};
  if (options_.planes.has(Plane::Id)) put_band(std::move(seen.faces), first, count, image.ids);
}

Image WholePicture::look() {
  Image image = empty_image(options_.samples);
  const std::vector<SampleGrid> grids = bands(options_.samples);
  band_count_ = grids.size();
  for (const SampleGrid& band : grids) {
    put_planes(see(with_directions(band)), image);
    ++bands_done_;
  }
  return image;
}

Image WholePicture::paint() {
  paints_ = true;
  Image image = empty_image(1);
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const bool wants_planes = !options_.planes.empty();
  // Planes always hold the ray through the pixel's centre.
  const bool centres_are_sampled = options_.samples == 1;
  const std::vector<SampleGrid> grids = bands(options_.samples);
  const std::vector<SampleGrid> centres = wants_planes && !centres_are_sampled ? bands(1) : std::vector<SampleGrid>();
  band_count_ = grids.size() + centres.size();
  const bool is_box = options_.filter == Renderer::Filter::Box;
  FilteredRows filtered(PixelFilter(options_.filter, options_.filter_width, options_.samples), image.width,
                        image.height, PicturePieces::of(view_, made_pixels(options_)));

  for (const SampleGrid& band : grids) {
    const SampleGrid grid = with_directions(band);
    Seen seen = see(grid);
    const Stopwatch shade_time;
    report(0.8, "shade");
    if (!transposes_) colors_.assign(grid.count(), options_.background);
    shade_points(scene_, grid, seen.points, lights_, options_, executor_, colors_, materials_);
    if (!is_box) {
      image.pixels.resize(pixels);
      filtered.add(grid.rows(), colors_, executor_, image.pixels.data());
    } else {
      if (!centres_are_sampled) colors_ = mean_of_samples(grid, colors_, executor_);
      put_band(std::move(colors_),
               first_row_of(grid) / static_cast<std::size_t>(options_.samples) * static_cast<std::size_t>(image.width),
               pixels, image.pixels);
    }
    if (wants_planes && centres_are_sampled) {
      put_planes(std::move(seen), image);
    }
    statistics_.shade_ms += shade_time.milliseconds();
    ++bands_done_;
  }
  paints_ = false;
  for (const SampleGrid& band : centres) {
    put_planes(see(with_directions(band)), image);
    ++bands_done_;
  }
  report_(1, "shade");
  return image;
}

}  // namespace facemap
