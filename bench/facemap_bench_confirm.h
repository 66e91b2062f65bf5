#pragma once

#include <facemap/image.h>

#include <vector>

#include "facemap_bench_cases.h"

namespace facemap::bench {

/// Of the samples in `where`, how many does `ours` answer as the lists of faces do, asked one by one: Camera::nearest
/// and PointLight::get_lighten_up, the definition of the answers.
std::size_t confirm(const Case& question, const View& view, const Options& options, const Image& ours,
                    const std::vector<std::size_t>& where);

}  // namespace facemap::bench
