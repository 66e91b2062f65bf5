#pragma once

#include <facemap/renderer.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "parallel/executor.h"
#include "render/picture_pieces.h"
#include "render/shade.h"

namespace facemap {

/// Fills an image from maps of faces, sample by sample: the loop over pixels, and which of them get more than one
/// sample. Of the planes it fills ids and lights. Rows are tasks; each worker has a shader of its own.
class Painter {
 public:
  /// `report` is called now and then with the fraction done; it may throw.
  using Report = std::function<void(double)>;

  /// `eye` is that of `view`.
  Painter(const View& view, const Eye& eye, std::span<const simd::LightSource> lights, const ListsOfLights& lists,
          const Renderer::Options& options, const MaterialTable* materials, const Executor& executor, Report report);

  /// Call once. Adds queries, tests and upsampled pixels to `statistics`.
  Image paint(Renderer::Statistics& statistics);

  /// The planes of ids and lights of all samples of the pixels' grids, in place of paint().
  Image look(Renderer::Statistics& statistics);

 private:
  struct Worker {
    Renderer::Statistics statistics;
    Shader shader;
    Sample sample, grid_sample;

    Worker(const Eye& eye, std::span<const simd::LightSource> lights, const ListsOfLights& lists,
           const Renderer::Options& options, const MaterialTable* materials)
        : shader(eye, lights, lists, options, statistics, materials) {}
  };

  void for_each_row(double done_before, double share, const std::function<void(int y, Worker&)>& paint_row);
  void paint_row(int y, int samples, Worker& worker);
  void look_at_row(int y, Worker& worker);
  void add_counts(Renderer::Statistics& statistics) const;
  void upsample_edges(int y, Worker& worker);
  void filter_samples(double done_before);
  void put_samples(int y, Worker& worker, Color* samples);
  bool is_made(int x, int y) const;
  void store_planes(std::size_t pixel, const Sample& sample);
  const Color& sample_of_grid(int x, int y, int i, int j, int samples, Worker& worker);
  Color mean_of_grid(int x, int y, int samples, Worker& worker);
  MapPoint place_in_grid(int x, int y, int i, int j, int samples) const;
  bool may_hold_edge(int x, int y, Worker& worker) const;
  bool shows_another_face(int x, int y, Worker& worker) const;
  bool same_lights(std::size_t i, std::size_t j) const;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x);
  }

  const Eye& eye_;
  const Renderer::Options& options_;
  const Executor& executor_;
  Report report_;
  std::mutex reporting_;
  int rows_done_ = 0;
  const PixelBox made_;  // of the picture: those that are asked for, and those about them that are looked at
  const PicturePieces pieces_;
  std::vector<std::unique_ptr<Worker>> workers_;
  Image image_;
};

}  // namespace facemap
