#pragma once

#include <facemap/renderer.h>

#include <cstddef>
#include <functional>

#include "render/shade.h"

namespace facemap {

/// Fills an image from a shader: the loop over pixels, and which of them get more than one sample.
class Painter {
 public:
  /// `report` is called now and then with the fraction done; it may throw.
  using Report = std::function<void(double)>;

  Painter(const Camera& camera, Shader& shader, const Renderer::Options& options, int light_count,
          Renderer::Statistics& statistics, Report report);

  /// Call once.
  Image paint();

 private:
  void paint_rows(int samples, double share);
  void upsample_edges();
  void store_planes(std::size_t pixel, const Sample& sample);
  Color mean_of_grid(int x, int y, int samples);
  bool may_hold_edge(int x, int y) const;
  bool same_lights(std::size_t i, std::size_t j) const;

  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(image_.width) + static_cast<std::size_t>(x);
  }

  const Camera& camera_;
  Shader& shader_;
  const Renderer::Options& options_;
  Renderer::Statistics& statistics_;
  Report report_;
  Sample grid_sample_;
  Image image_;
};

}  // namespace facemap
