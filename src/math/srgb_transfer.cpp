#include "math/srgb_transfer.h"

#include "math/elementary.h"

namespace facemap {

double linear_from_srgb(double encoded) {
  if (encoded <= 0.04045) return encoded / 12.92;
  return elementary::pow((encoded + 0.055) / 1.055, 2.4);
}

}  // namespace facemap
