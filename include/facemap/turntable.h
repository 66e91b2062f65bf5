#pragma once

#include <facemap/renderer.h>

#include <vector>

namespace facemap {

/// `count` views of which the camera goes once around: the first one's position, turned about the axis through its
/// look_at along its `up` by equal angles, counter-clockwise seen from above. All else stays as it is. The same bits
/// on every machine. Throws Error if count is below 1 or `up` is zero or not finite.
std::vector<View> turntable(const View& first, int count);

}  // namespace facemap
