#pragma once

#include <stdexcept>

namespace facemap::program {

/// A command line that makes no sense: exit code 2. (Bad files are facemap::Error: exit code 1.)
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace facemap::program
