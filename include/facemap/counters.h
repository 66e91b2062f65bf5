#pragma once

#include <cstdint>

namespace facemap {

/// How often each stage of the predicates decided a test of one face: the float32 filter, double precision
/// with a bound of its own error, exact integers.
struct Counters {
  std::uint64_t by_float = 0;
  std::uint64_t by_double = 0;
  std::uint64_t by_exact = 0;

  Counters& operator+=(const Counters& other) {
    by_float += other.by_float;
    by_double += other.by_double;
    by_exact += other.by_exact;
    return *this;
  }
};

}  // namespace facemap
