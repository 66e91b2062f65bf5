#pragma once

#include <facemap/vector.h>

#include <cmath>
#include <cstdint>

/// Random numbers that are the same on every machine: splitmix64 (Steele, Lea, Flood 2014).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }

  /// 0 .. count - 1
  int below(int count) { return static_cast<int>(next() % static_cast<std::uint64_t>(count)); }
  int between(int low, int high) { return low + below(high - low + 1); }
  bool chance(double probability) { return unit() < probability; }

  /// [0, 1)
  double unit() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * unit(); }

  /// In the cube [-1, 1)^3.
  facemap::DVector in_cube() {
    const double x = between(-1.0, 1.0), y = between(-1.0, 1.0), z = between(-1.0, 1.0);
    return {x, y, z};
  }

  /// Of unit length, all directions alike.
  facemap::DVector direction() {
    while (true) {
      const facemap::DVector v = in_cube();
      const double square = v.x * v.x + v.y * v.y + v.z * v.z;
      if (square > 1e-3 && square <= 1) return v / std::sqrt(square);
    }
  }

 private:
  std::uint64_t state_;
};
