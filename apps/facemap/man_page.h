#pragma once

#include <string>
#include <vector>

#include "options.h"

namespace facemap::program {

/// facemap(1): the texts of --help as a manual page in roff.
std::string man_page(const std::vector<Command>& commands);

}  // namespace facemap::program
