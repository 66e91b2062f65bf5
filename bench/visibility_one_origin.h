#pragma once

#include "visibility_options.h"

namespace facemap::bench {

/// Prints the rows of one origin at a time: Viewpoint::visible beside Embree, built beforehand and with builds.
void measure_one_origin(const VisibilitySettings& settings);

}  // namespace facemap::bench
