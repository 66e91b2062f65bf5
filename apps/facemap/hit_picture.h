#pragma once

#include <facemap/camera.h>
#include <facemap/image.h>

#include <vector>

namespace facemap::program {

/// How many faces the ray through the centre of each texel meets, row by row; kNoDirection where a texel's
/// centre has no direction (outside 360 degrees). `map` must keep all faces. `threads` count, 1 or more.
inline constexpr int kNoDirection = -1;
std::vector<int> count_hits_by_texel(const Camera& map, int threads);

/// Wang 2022, Fig. 9: a texel is the darker the more faces lie there. A legend with the numbers stands below.
Image hit_picture(const std::vector<int>& hits, int width, int height);

}  // namespace facemap::program
