#include "simd/target.h"

#include <facemap/error.h>

#include <atomic>
#include <cstdlib>
#include <string>

namespace facemap::simd {
namespace {

constexpr Target kAllTargets[] = {Target::Scalar, Target::Sse4, Target::Avx2, Target::Avx512};

bool is_supported(Target target) {
#if defined(__x86_64__)
  // What Highway's code for each target may use.
  const bool sse4 =
      __builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("pclmul") && __builtin_cpu_supports("aes");
  const bool avx2 = sse4 && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("bmi") &&
                    __builtin_cpu_supports("bmi2") && __builtin_cpu_supports("fma");
  const bool avx512 = avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
                      __builtin_cpu_supports("avx512dq") && __builtin_cpu_supports("avx512bw");
  switch (target) {
    case Target::Scalar:
      return true;
    case Target::Sse4:
      return sse4;
    case Target::Avx2:
      return avx2;
    case Target::Avx512:
      return avx512;
  }
#endif
  return target == Target::Scalar;
}

Target wanted_target() {
  const char* wanted = std::getenv("FACEMAP_TARGET");
  if (wanted == nullptr || *wanted == '\0') return supported_targets().back();
  for (const Target target : kAllTargets) {
    if (std::string(wanted) != name_of(target)) continue;
    if (!is_supported(target)) throw Error("FACEMAP_TARGET: this processor cannot run " + std::string(wanted));
    return target;
  }
  throw Error("FACEMAP_TARGET must be scalar, sse4, avx2 or avx512, not \"" + std::string(wanted) + "\"");
}

std::atomic<Target>& chosen_target() {
  static std::atomic<Target> target = wanted_target();
  return target;
}

}  // namespace

std::vector<Target> supported_targets() {
  std::vector<Target> targets;
  for (const Target target : kAllTargets) {
    if (is_supported(target)) targets.push_back(target);
  }
  return targets;
}

Target active_target() { return chosen_target().load(std::memory_order_relaxed); }

void set_active_target(Target target) { chosen_target().store(target, std::memory_order_relaxed); }

const char* name_of(Target target) {
  switch (target) {
    case Target::Sse4:
      return "sse4";
    case Target::Avx2:
      return "avx2";
    case Target::Avx512:
      return "avx512";
    case Target::Scalar:
      break;
  }
  return "scalar";
}

}  // namespace facemap::simd
