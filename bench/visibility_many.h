#pragma once

#include "visibility_options.h"

namespace facemap::bench {

/// Prints the rows of many origins at once: visibility() beside Embree, builds of both included.
void measure_many_origins(const VisibilitySettings& settings);

}  // namespace facemap::bench
