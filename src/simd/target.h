#pragma once

#include <vector>

namespace facemap::simd {

/// Instruction sets that kernels are compiled for, worst to best. Scalar is the definition: the others give its bits.
/// On machines without these names Scalar stands for what the compiler takes as the baseline.
enum class Target { Scalar, Sse4, Avx2, Avx512 };

/// What this processor can run, worst to best.
std::vector<Target> supported_targets();

/// The one that kernels use: FACEMAP_TARGET (scalar, sse4, avx2 or avx512) if it is set, else the best supported.
/// Throws Error if the variable names something else or what this processor cannot run.
Target active_target();

/// From now on kernels use `target`, which must be supported. For tests and benchmarks; not while kernels run.
void set_active_target(Target target);

/// The name FACEMAP_TARGET takes.
const char* name_of(Target target);

}  // namespace facemap::simd
