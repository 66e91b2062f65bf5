#pragma once

#include <string>
#include <vector>

#include "options.h"

namespace facemap::program {

/// What facemap --help prints.
std::string program_help(const std::vector<Command>& commands);

/// What facemap COMMAND --help prints.
std::string command_help(const Command& command);

/// docs/cli.md: the same texts as a page.
std::string markdown_help(const std::vector<Command>& commands);

}  // namespace facemap::program
