#include "render/cost_model.h"

#include <cstdio>

namespace facemap {
namespace {

// Nanoseconds on one core, medians over the scenes of docs/benchmarks.md. Only their ratios matter, and only near the
// point where both strategies cost the same.
constexpr double kTransposedFace = 6;      // a face, for the camera and for each light
constexpr double kTransposedQuery = 10;    // a sample, for the camera and for each light
constexpr double kListQuery = 60;          // a point asked of a light's lists
constexpr double kListCameraQuery = 150;   // a ray asked of the camera's lists, their part of the building included
constexpr double kListCameraFace = 250;    // a face of the camera's lists
constexpr double kListFace = 400;          // a face of a light's lists
constexpr double kListBytesPerFace = 150;  // of one light

// Share of a picture's samples that ask a light: those that hit a face which the light faces.
constexpr double kAsked = 0.4;

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
  cost.transposed =
      ((1 + lights) * faces * kTransposedFace + (1 + lights * kAsked) * samples * kTransposedQuery) * 1e-6;
  cost.lists = (faces * kListCameraFace + samples * kListCameraQuery + lights * kAsked * samples * kListQuery) * 1e-6;
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
