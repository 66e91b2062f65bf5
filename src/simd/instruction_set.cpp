#include <facemap/instruction_set.h>

#include "simd/target.h"

namespace facemap {

std::string instruction_set() { return simd::name_of(simd::active_target()); }

}  // namespace facemap
