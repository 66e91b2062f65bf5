#include <algorithm>
#include <cstddef>
#include <span>

#include "render/divided_pixels.h"
#include "render/edge_pixels.h"
#include "render/shade_picture.h"
#include "render/stopwatch.h"
#include "render/whole_picture.h"

namespace facemap {
namespace {

// Samples of a band of which few are shaded. Faces are found for fewer at a time.
constexpr std::size_t kLargestDivided = std::size_t{1} << 24;

}  // namespace

// One ray a pixel, then the samples of the pixels that may hold an edge. The camera's faces are found for all samples:
// that costs little beside light, and no edge between faces is missed.
Image WholePicture::paint_edges() {
  Image image = empty_image(1);
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  const int n = options_.samples;
  image.pixels.resize(pixels);
  EdgePixels edges(scene_, view_, options_, materials_, executor_);
  const std::vector<SampleGrid> grids = bands(n, view_.lens ? kLargestBand : kLargestDivided);
  const bool keeps_faces = grids.size() == 1;
  NearestFaces kept;
  band_count_ = bands(1).size() + 2 * grids.size();
  paint_centres(edges, image);

  const bool is_box = options_.filter == Renderer::Filter::Box;
  DividedPixels divided(PixelFilter(options_.filter, options_.filter_width, n), is_box, edges, image.pixels);
  for (int round = 0; round <= EdgePixels::kRounds && (round == 0 || edges.next_round()); ++round) {
    const bool is_first = round == 0;
    for (SampleGrid grid : grids) {
      const int first = static_cast<int>(first_row_of(grid)) / n, rows = grid.rows() / n;
      if (!is_first && !edges.any_divided(first, first + rows)) continue;
      if (first + rows < image.height) grid.row_count += n;
      grid = with_directions(grid);
      NearestFaces nearest = is_first || !keeps_faces ? faces_of_parts(grid) : std::move(kept);
      if (is_first) edges.find_edges(grid, rows, nearest.faces);
      if (is_first && keeps_faces) kept = {nearest.faces, nearest.loose};
      edges.keep_divided(grid, rows, nearest.faces);
      divide(grid, rows, std::move(nearest), round < EdgePixels::kRounds, edges, divided);
      bands_done_ = std::min(bands_done_ + 1, band_count_ - 1);
    }
  }
  const Stopwatch filter_time;
  divided.finish(executor_);
  statistics_.upsampled_pixels = divided.count();
  statistics_.shade_ms += filter_time.milliseconds();
  report_(1, "shade");
  return image;
}

void WholePicture::paint_centres(EdgePixels& edges, Image& image) {
  for (const SampleGrid& band : bands(1)) {
    const SampleGrid grid = with_directions(band);
    Seen seen = see(grid);
    const Stopwatch shade_time;
    const PointLooks looks = look_at_points(scene_, grid, seen.points, lights_, options_, executor_, materials_);
    const UnsetVector<std::uint32_t>& samples = seen.points.points.samples;
    const std::span<Color> colors(image.pixels.data() + first_row_of(grid) * static_cast<std::size_t>(image.width),
                                  grid.count());
    std::fill(colors.begin(), colors.end(), options_.background);
    for (std::size_t i = 0; i < samples.size(); ++i) colors[samples[i]] = looks.colors[i];
    edges.set_centres(grid, seen.faces, {samples, looks.masks, seen.points.stride}, colors);
    put_planes(std::move(seen), image);
    statistics_.shade_ms += shade_time.milliseconds();
    ++bands_done_;
  }
}

// As nearest_faces() has them, a few rows at a time.
NearestFaces WholePicture::faces_of_parts(const SampleGrid& grid) {
  const int n = grid.per_side, columns = grid.columns(), end = grid.first_row + grid.rows();
  const int rows = std::max(n, static_cast<int>(kLargestBand / static_cast<std::size_t>(columns)) / n * n);
  if (rows >= grid.rows()) return nearest_faces(grid);
  NearestFaces all;
  all.faces.reserve(grid.count());
  SampleGrid part = grid;
  part.directions = nullptr;
  for (; part.first_row < end; part.first_row += rows) {
    part.row_count = std::min(rows, end - part.first_row);
    const NearestFaces nearest = nearest_faces(with_directions(part));
    const auto first = static_cast<std::uint32_t>(all.faces.size());
    for (const std::uint32_t sample : nearest.loose) all.loose.push_back(first + sample);
    all.faces.insert(all.faces.end(), nearest.faces.begin(), nearest.faces.end());
  }
  return all;
}

// `rows` rows of pixels; the grid may have one more, for what is known of its neighbours.
void WholePicture::divide(const SampleGrid& grid, int rows, NearestFaces nearest, bool spreads, EdgePixels& edges,
                          DividedPixels& divided) {
  const Seen seen = see(grid, std::move(nearest));
  const Stopwatch shade_time;
  const PointLooks looks = look_at_points(scene_, grid, seen.points, lights_, options_, executor_, materials_);
  const UnsetVector<std::uint32_t>& samples = seen.points.points.samples;
  const DividedPlaces places = edges.places_of_divided(grid, rows);
  if (spreads) edges.spread(grid, rows, places, seen.faces, {samples, looks.masks, seen.points.stride});
  divided.take(edges.first_pixel(grid), places, samples, looks.colors, options_.background);
  statistics_.shade_ms += shade_time.milliseconds();
}

}  // namespace facemap
