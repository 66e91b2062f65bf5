#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace facemap::bench {

/// What the command line asks for.
struct VisibilitySettings {
  std::vector<std::string> scenes{"chessboard"};  ///< as facemap-bench names them
  std::size_t points = 1000000;
  bool many = false;           ///< many origins at once
  std::size_t origins = 1000;  ///< of those
  std::vector<int> threads{1, 2};
  int repeat = 7;  ///< interleaved rounds
  std::uint64_t seed = 5;
};

/// Reads the command line. Prints and exits for --help and for mistakes.
VisibilitySettings read_visibility_settings(int argc, char** argv);

}  // namespace facemap::bench
