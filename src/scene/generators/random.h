#pragma once

#include <cstdint>

namespace facemap::generators {

/// The splitmix64 generator of Steele, Lea and Flood (2014): the same numbers everywhere, unlike std distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  /// Uniform in [low, high).
  double between(double low, double high) { return low + (high - low) * unit(); }

 private:
  double unit() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

  std::uint64_t state_;
};

}  // namespace facemap::generators
