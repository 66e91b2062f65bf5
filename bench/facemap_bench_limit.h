#pragma once

#include <facemap/renderer.h>

#include "facemap_bench_cases.h"
#include "facemap_bench_embree.h"

namespace facemap::bench {

/// What a query costs at the least if a map about the light answers it: the point is projected, a texel of a 128 x 128
/// map is read, and of its list one face is left, the one that decides (none for a lit point), whose four planes are
/// tested. Nanoseconds a query on one thread, the best of `repeat` passes over all queries of `answer`, the picture of
/// `question` from `view`. `embree`, built, names the deciding faces.
double limit_ns(const Case& question, const View& view, const Image& answer, const Embree& embree, int samples,
                int repeat);

}  // namespace facemap::bench
