#pragma once

#include <facemap/vector.h>

#include <cmath>

#include "math/exact_sign.h"
#include "support/random.h"

/// Triangles and points for predicates, each kind for another stage to decide.
namespace sign_inputs {

using facemap::DVector;
using facemap::Triangle;
using facemap::Vector;

enum class Kind {
  Grid,    ///< small integers: ties abound
  Plain,   ///< within 1 of the origin
  Close,   ///< within 2 ulp of 1
  Far,     ///< within 1 of 1000
  Wide,    ///< from 2^-60 to 2^20
  Wild,    ///< any floats
  Tiny,    ///< a grid of 2^-40
  Huge,    ///< a grid of 2^40
  Offset,  ///< within 1 of 1e6, hence on a grid of 2^-4
  kCount,
};

class Inputs {
 public:
  Inputs(Kind kind, std::uint64_t seed) : kind_(kind), random_(seed) {}

  float coordinate() {
    switch (kind_) {
      case Kind::Grid:
        return static_cast<float>(random_.between(-2, 2));
      case Kind::Plain:
        return static_cast<float>(random_.between(-1.0, 1.0));
      case Kind::Close:
        return static_cast<float>(1 + random_.between(-2, 2) * 0x1p-23);
      case Kind::Far:
        return static_cast<float>(1000 + random_.between(-1.0, 1.0));
      case Kind::Wide:
        return scaled(-60, 20);
      case Kind::Tiny:
        return static_cast<float>(random_.between(-3, 3)) * 0x1p-40f;
      case Kind::Huge:
        return static_cast<float>(random_.between(-3, 3)) * 0x1p40f;
      case Kind::Offset:
        return static_cast<float>(1e6 + random_.between(-1.0, 1.0));
      default:
        return scaled(-149, 127);
    }
  }

  Vector vector() {
    const float x = coordinate(), y = coordinate(), z = coordinate();
    return Vector(x, y, z);
  }

  Triangle triangle() {
    const Vector a = vector(), b = vector(), c = vector();
    return {a, b, c};
  }

  /// A corner, a point of an edge or of the plane, or any point; floats, hence close to it only.
  Vector near(const Triangle& f) {
    const int choice = random_.below(5);
    if (choice == 0) return f[random_.below(3)];
    if (choice == 1) return vector();
    const double p = choice == 2 ? 0 : random_.between(-0.5, 1.5), q = choice == 3 ? 0.5 : random_.unit();
    const DVector a(f[0]), b(f[1]), c(f[2]);
    return finite(Vector(a + p * (b - a) + q * (c - a)));
  }

  /// Shares corners with f, or lies about in its plane, or not.
  Triangle neighbour(const Triangle& f) {
    const int shared = random_.below(4);
    const Vector a = shared > 0 ? f[random_.below(3)] : near(f), b = shared > 1 ? f[random_.below(3)] : near(f);
    const Vector c = near(f);
    return {a, b, c};
  }

  int below(int count) { return random_.below(count); }

  static Vector finite(const Vector& v) {
    const auto bounded = [](float x) { return std::isfinite(x) ? x : 1.0f; };
    return {bounded(v.x), bounded(v.y), bounded(v.z)};
  }

 private:
  float scaled(int low, int high) {
    if (random_.chance(0.1)) return 0;
    const float magnitude = std::ldexp(static_cast<float>(1 + random_.unit()), random_.between(low, high));
    return std::isfinite(magnitude) ? (random_.chance(0.5) ? magnitude : -magnitude) : 1.0f;
  }

  Kind kind_;
  Random random_;
};

}  // namespace sign_inputs
