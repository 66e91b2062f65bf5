#pragma once

namespace facemap::program {

inline constexpr int kDone = 0, kFailed = 1, kWrongUsage = 2;

}  // namespace facemap::program
