#include "render/cost_model.h"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace facemap {
namespace {

// Nanoseconds on one core for a light, about the middle of the scenes of docs/benchmarks.md, which lie within a factor
// of three. What the camera sees costs the same either way and is left out.
constexpr double kTransposedFace = 20;      // a face that runs over the points
constexpr double kTransposedQuery = 8;      // a point that is sorted
constexpr double kListQuery = 120;          // a point asked of lists
constexpr double kListFace = 300;           // a face put into lists
constexpr double kBoundsFace = 450;         // a face that takes part in making a light's bounds
constexpr double kBoundedShare = 0.6;       // of the transposed way's time, when bounds are there
constexpr double kBytesOfBounds = 1 << 20;  // of one light, and those a face
constexpr double kBoundsBytesPerFace = 26;
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
  cost.bounded = cost.transposed * kBoundedShare;
  cost.make_bounds = lights * faces * kBoundsFace * 1e-6;
  cost.lists = queries * kListQuery * 1e-6;
  cost.build_lists = lights * faces * kListFace * 1e-6;
  return cost;
}

namespace {

// As with lists: once earlier pictures have lost as much as making them costs.
bool keeps_bounds(const Renderer::Options& options, const PictureWork& work) {
  using LightMaps = Renderer::LightMaps;
  if (options.light_maps != LightMaps::Auto) return options.light_maps == LightMaps::Keep;
  const double bytes = static_cast<double>(work.lights) *
                       std::max(kBytesOfBounds, kBoundsBytesPerFace * static_cast<double>(work.faces));
  if (work.map_memory != 0 && bytes > static_cast<double>(work.map_memory)) return false;
  return work.has_bounds || work.lost_to_bounds >= estimate_cost(work).make_bounds;
}

StrategyChoice transposed(const Renderer::Options& options, const PictureWork& work, std::string reason) {
  const bool keeps = keeps_bounds(options, work);
  if (keeps) reason += work.has_bounds ? "; light maps are kept" : "; light maps are made to be kept";
  return {Renderer::Strategy::Transposed, std::move(reason), keeps};
}

}  // namespace

StrategyChoice choose_strategy(const Renderer::Options& options, const PictureWork& work) {
  using Strategy = Renderer::Strategy;
  if (options.builder == Builder::Fill) return {Strategy::Lists, "the published builder makes lists"};
  if (is_by_samples(options)) return {Strategy::Lists, "edges of one sample a pixel are asked of lists"};
  if (options.strategy == Strategy::Lists) return {Strategy::Lists, "asked for"};
  if (options.strategy == Strategy::Transposed) return transposed(options, work, "asked for");
  const double list_bytes = static_cast<double>(work.faces) * static_cast<double>(work.lights) * kListBytesPerFace;
  if (work.map_memory != 0 && list_bytes > static_cast<double>(work.map_memory)) {
    return transposed(options, work, "lists would not fit the map memory");
  }
  const PictureCost cost = estimate_cost(work);
  const double by_transposed = work.has_bounds ? cost.bounded : cost.transposed;
  std::string reason =
      "estimated " + in_milliseconds(by_transposed) + " transposed, " + in_milliseconds(cost.lists) + " by lists";
  // Lists are built once earlier pictures have cost as much as building them would have (ski rental: never more than
  // twice the best choice in hindsight).
  const double building = work.has_lists ? 0 : std::max(0.0, cost.build_lists - work.spent_in_vain);
  reason += work.has_lists ? ", which are built" : " and " + in_milliseconds(cost.build_lists) + " to build them";
  if (cost.lists + building < by_transposed) return {Strategy::Lists, std::move(reason)};
  return transposed(options, work, std::move(reason));
}

}  // namespace facemap
