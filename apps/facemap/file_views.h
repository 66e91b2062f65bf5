#pragma once

#include <vector>

#include "input.h"

namespace facemap::program {

/// The views that are wanted: those of the command line, or of the file's cameras. `given` are the words of the command
/// line, which go before what a camera says. Throws UsageError if a camera is named that is not there.
std::vector<WantedView> wanted_views(const RenderArguments& arguments, const Words& given, const Input& input,
                                     const Loaded& loaded);

/// The lights that are wanted, and whether they were made up.
struct WantedLights {
  std::vector<Light> lights;
  bool are_made_up = false;
};
WantedLights wanted_lights(const RenderArguments& arguments, const Input& input, const Loaded& loaded);

}  // namespace facemap::program
