// Lets ctest run a program once for each instruction set by FACEMAP_TARGET: where the processor lacks it, there is
// nothing to run.

#include <cstdio>
#include <cstdlib>
#include <string>

#include "simd/target.h"

namespace {

bool skip_what_cannot_run() {
  const char* wanted = std::getenv("FACEMAP_TARGET");
  if (wanted == nullptr) return true;
  for (const facemap::simd::Target target : facemap::simd::supported_targets()) {
    if (std::string(wanted) == facemap::simd::name_of(target)) return true;
  }
  std::printf("skipped: this processor cannot run %s\n", wanted);
  std::exit(0);
}

const bool can_run = skip_what_cannot_run();

}  // namespace
