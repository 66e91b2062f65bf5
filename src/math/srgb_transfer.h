#pragma once

namespace facemap {

/// IEC 61966-2-1: the linear value of an encoded one in 0..1.
double linear_from_srgb(double encoded);

}  // namespace facemap
