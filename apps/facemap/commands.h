#pragma once

#include <vector>

#include "options.h"

namespace facemap::program {

Command render_command();
Command info_command();
Command map_command();
Command compare_command();
Command sheet_command();
Command scene_command();

/// All of them, in the order of the help.
std::vector<Command> all_commands();

}  // namespace facemap::program
