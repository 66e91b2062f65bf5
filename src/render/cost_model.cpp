#include "render/cost_model.h"

#include <cstdio>

namespace facemap {
namespace {

// Nanoseconds on one core for a light, about the middle of the scenes of docs/benchmarks.md, which lie within a factor
// of three. What the camera sees costs the same either way and is left out.
constexpr double kTransposedFace = 20;     // a face that runs over the points
constexpr double kTransposedQuery = 8;     // a point that is sorted
constexpr double kListQuery = 120;         // a point asked of lists
constexpr double kListFace = 300;          // a face put into lists
constexpr double kListBytesPerFace = 100;  // of the lists and planes of one light

// Share of a picture's samples that ask a light: those that hit a face which the light faces.
constexpr double kAsked = 0.3;

std::string in_milliseconds(double ms) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g ms", ms);
  return text;
}

}  // namespace

PictureCost estimate_cost(const PictureWork& work) {
  const auto faces = static_cast<double>(work.faces), samples = static_cast<double>(work.samples);
  const auto lights = static_cast<double>(work.lights);
  PictureCost cost;
  const double queries = lights * kAsked * samples;
  cost.transposed = (lights * faces * kTransposedFace + queries * kTransposedQuery) * 1e-6;
  cost.lists = queries * kListQuery * 1e-6;
  cost.build_lists = lights * faces * kListFace * 1e-6;
  return cost;
}

StrategyChoice choose_strategy(const Renderer::Options& options, const PictureWork& work) {
  using Strategy = Renderer::Strategy;
  if (options.builder == Builder::Fill) return {Strategy::Lists, "the published builder makes lists"};
  if (options.sampling == Renderer::Sampling::Edges) {
    return {Strategy::Lists, "pixels with edges are known from the camera's lists"};
  }
  if (options.strategy != Strategy::Auto) return {options.strategy, "asked for"};
  const double list_bytes = static_cast<double>(work.faces) * static_cast<double>(work.lights) * kListBytesPerFace;
  if (work.map_memory != 0 && list_bytes > static_cast<double>(work.map_memory)) {
    return {Strategy::Transposed, "lists would not fit the map memory"};
  }
  const PictureCost cost = estimate_cost(work);
  const std::string estimates =
      "estimated " + in_milliseconds(cost.transposed) + " transposed, " + in_milliseconds(cost.lists) + " by lists";
  if (work.has_lists) {
    return {cost.lists < cost.transposed ? Strategy::Lists : Strategy::Transposed, estimates + ", which are built"};
  }
  // Lists are built once earlier pictures have cost as much as building them would have (ski rental: never more than
  // twice the best choice in hindsight).
  const double building = cost.build_lists - work.spent_in_vain;
  return {cost.lists + (building > 0 ? building : 0) < cost.transposed ? Strategy::Lists : Strategy::Transposed,
          estimates + " and " + in_milliseconds(cost.build_lists) + " to build them"};
}

}  // namespace facemap
