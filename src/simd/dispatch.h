#pragma once

#include "simd/target.h"

/// FACEMAP_DISPATCH(kernel)(arguments...): calls the kernel's code for the active target. For use at the end (HWY_ONCE)
/// of a file that hwy/foreach_target.h compiles once a target, inside namespace facemap::simd.
#if (HWY_TARGETS & HWY_SSE4) && (HWY_TARGETS & HWY_AVX2) && (HWY_TARGETS & HWY_AVX3)
#define FACEMAP_DISPATCH(kernel) \
  ::facemap::simd::choose(&HWY_STATIC_DISPATCH(kernel), &N_SSE4::kernel, &N_AVX2::kernel, &N_AVX3::kernel)
#else
#define FACEMAP_DISPATCH(kernel) HWY_STATIC_DISPATCH(kernel)
#endif

namespace facemap::simd {

template <class Kernel>
Kernel* choose(Kernel* scalar, Kernel* sse4, Kernel* avx2, Kernel* avx512) {
  switch (active_target()) {
    case Target::Sse4:
      return sse4;
    case Target::Avx2:
      return avx2;
    case Target::Avx512:
      return avx512;
    case Target::Scalar:
      break;
  }
  return scalar;
}

}  // namespace facemap::simd
