#pragma once

#if defined(__SSE2__)
#include <immintrin.h>
#endif

namespace facemap {

/// Sets the default floating-point mode (round to nearest, no flush-to-zero, no denormals-are-zero) for its
/// lifetime and restores the caller's after it: other libraries set their own, and the bounds assume this one.
/// On machines without SSE2 the mode is left as it is.
class FloatingPointMode {
 public:
#if defined(__SSE2__)
  FloatingPointMode() : saved_(_mm_getcsr()) {
    if ((saved_ & kModeBits) != 0) _mm_setcsr(saved_ & ~kModeBits);
  }
  ~FloatingPointMode() {
    if ((saved_ & kModeBits) != 0) _mm_setcsr(saved_);
  }
#else
  FloatingPointMode() {}
#endif
  FloatingPointMode(const FloatingPointMode&) = delete;
  FloatingPointMode& operator=(const FloatingPointMode&) = delete;

 private:
#if defined(__SSE2__)
  static constexpr unsigned kModeBits = 0x8000u | 0x6000u | 0x0040u;  // flush-to-zero, rounding, denormals-are-zero
  unsigned saved_;
#endif
};

}  // namespace facemap
