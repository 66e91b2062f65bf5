#include "math/positive_range.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace facemap {
namespace {

constexpr int kMostCoefficients = 20;

// With x = t / (1 - t), p(x) (1 - t)^n = sum c_k t^k (1 - t)^(n - k): in Bernstein's basis on 0 <= t <= 1 the
// coefficients are c_k over the binomial n choose k. A polynomial lies above its least coefficient (Farouki and Rajan
// 1987).
struct Bernstein {
  std::array<double, kMostCoefficients> values;
  int count;

  bool is_above(double level) const {
    return std::all_of(values.begin(), values.begin() + count, [&](double value) { return value > level; });
  }
};

// De Casteljau's two halves.
void split(const Bernstein& whole, Bernstein& left, Bernstein& right) {
  right = whole;
  left.count = whole.count;
  for (int k = 0; k < whole.count; ++k) {
    left.values[k] = right.values[0];
    for (int i = 0; i + k + 1 < whole.count; ++i) right.values[i] = 0.5 * (right.values[i] + right.values[i + 1]);
  }
}

// Pieces of this width are not halved again.
constexpr double kNarrowest = 0x1p-50;

// The end of the part of [low, low + width] from low on that is surely above `level`. At most 50 calls deep.
double sure_end(const Bernstein& piece, double level, double low, double width) {
  if (piece.is_above(level)) return low + width;
  if (width <= kNarrowest) return low;
  Bernstein left, right;
  split(piece, left, right);
  const double middle = low + 0.5 * width;
  const double end = sure_end(left, level, low, 0.5 * width);
  return end < middle ? end : sure_end(right, level, middle, 0.5 * width);
}

}  // namespace

double positive_range(std::span<const double> coefficients) {
  assert(coefficients.size() <= kMostCoefficients);
  int count = static_cast<int>(coefficients.size());
  while (count > 1 && coefficients[count - 1] == 0) --count;
  Bernstein whole{{}, count};
  double binomial = 1, largest = 0;
  for (int k = 0; k < count; ++k) {
    whole.values[k] = coefficients[k] / binomial;
    largest = std::max(largest, std::fabs(whole.values[k]));
    if (!std::isfinite(coefficients[k])) return 0;
    binomial = binomial * (count - 1 - k) / (k + 1);
  }
  // A mean rounds by 2^-53 of the largest value; 50 halvings of degree 19 take 950 of them, one after another.
  const double rounding = 0x1p-42 * largest;
  const double end = sure_end(whole, rounding, 0, 1);
  if (end == 1) return std::numeric_limits<double>::infinity();
  return end / (1 - end) * (1 - 0x1p-50);
}

}  // namespace facemap
