#pragma once

#include <string>
#include <vector>

#include "options.h"

namespace facemap::program {

/// Scripts that a shell reads to complete command lines of the program: commands, flags, the words that a flag takes,
/// file names.
std::string bash_completion(const std::vector<Command>& commands);
std::string zsh_completion(const std::vector<Command>& commands);
std::string fish_completion(const std::vector<Command>& commands);

}  // namespace facemap::program
