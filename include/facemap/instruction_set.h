#pragma once

#include <string>

namespace facemap {

/// The instruction set that the library's kernels use: "scalar", "sse4", "avx2" or "avx512". The processor's best, or
/// what the environment variable FACEMAP_TARGET names; results are the same. Throws Error if the variable names
/// something else or what this processor cannot run.
std::string instruction_set();

}  // namespace facemap
