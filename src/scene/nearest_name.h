#pragma once

#include <string>
#include <vector>

namespace facemap {

/// "; did you mean X?" for the known name nearest to `word` by letters to insert, drop or replace; nothing if none is
/// near.
std::string name_suggestion(const std::string& word, const std::vector<std::string>& known);

/// "a, b, c".
std::string name_list(const std::vector<std::string>& names);

}  // namespace facemap
