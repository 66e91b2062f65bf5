#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace facemap::bench {

/// Median and spread of a few numbers.
struct Spread {
  double median = 0, least = 0, most = 0;
};

inline Spread spread_of(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t half = values.size() / 2;
  const double median = values.size() % 2 ? values[half] : (values[half - 1] + values[half]) / 2;
  return {median, values.front(), values.back()};
}

}  // namespace facemap::bench
