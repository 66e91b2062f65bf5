#pragma once

#include <facemap/renderer.h>

#include <string>

namespace facemap {

/// Throw Error, naming what is out of range.
void check_options(const Renderer::Options& options);
void check_light(const Light& light, const std::string& name);

}  // namespace facemap
