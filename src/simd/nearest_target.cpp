#include "simd/nearest_target.h"

namespace facemap::simd {

void add_contest(Contests& contests, const Contest& contest) { contests.push_back(contest); }

}  // namespace facemap::simd
