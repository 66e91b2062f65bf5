#pragma once

#include <facemap/renderer.h>

#include <cstddef>
#include <string>

namespace facemap {

/// What a picture asks, and what is there already.
struct PictureWork {
  std::size_t faces = 0;    ///< kept faces of the scene
  std::size_t samples = 0;  ///< rays of the picture
  std::size_t lights = 0;
  bool has_lists = false;      ///< the lights' lists are built
  bool has_bounds = false;     ///< bounds of the lights are made (LightBounds)
  double spent_in_vain = 0;    ///< milliseconds that earlier pictures would have saved had the lists been there
  double lost_to_bounds = 0;   ///< the same for the bounds
  std::size_t map_memory = 0;  ///< Options::map_memory
};

/// Whether a picture is made sample by sample from lists of faces, by Painter: the published builder needs it, and with
/// Sampling::Edges but nothing to divide it is what the ways that take all samples together are held against.
inline bool is_by_samples(const Renderer::Options& options) {
  return options.builder == Builder::Fill || (options.sampling == Renderer::Sampling::Edges && options.samples == 1);
}

/// Estimated milliseconds of one thread for all lights' shadows, by each strategy.
struct PictureCost {
  double transposed = 0;
  double bounded = 0;      ///< transposed, with the lights' bounds made
  double make_bounds = 0;  ///< of all lights
  double lists = 0;        ///< with the lights' lists built
  double build_lists = 0;  ///< of all lights
};
PictureCost estimate_cost(const PictureWork& work);

/// The strategy to take, and why in a few words.
struct StrategyChoice {
  Renderer::Strategy strategy;
  std::string reason;
  bool keeps_bounds = false;  ///< with Strategy::Transposed
};
StrategyChoice choose_strategy(const Renderer::Options& options, const PictureWork& work);

}  // namespace facemap
