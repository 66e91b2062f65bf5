#pragma once

#include <string>
#include <vector>

#include "facemap_bench_rounds.h"

namespace facemap::bench {

/// What the numbers were measured on and with: one line.
std::string setting(const Options& options);

void print_case(const Case& question, const Measured& measured, const Options& options);

/// Speeds of all cases, their geometric means and least.
struct Speeds {
  std::string name;
  double cold, warm;
};
void print_summary(const std::vector<Speeds>& speeds);

/// One line of JSON. Throws Error if `file` cannot be written.
std::string json_line(const Case& question, const Measured& measured, const Options& options);

}  // namespace facemap::bench
