#pragma once

#include <cstdint>

namespace facemap::bench {

/// Counts what the whole program allocates: malloc and its kin (operator new calls them) and anonymous mappings,
/// those of linked libraries included.
class MemoryMeter {
 public:
  /// Starts at 0 held, 0 at the peak.
  static void start();
  /// Forgets the peak: from now on it is that of what comes, with what is held.
  static void forget_peak();
  /// Bytes held at the most since start() or forget_peak(), beyond what was held then. Stops counting.
  static std::int64_t stop();
};

}  // namespace facemap::bench
