#pragma once

#include <string>
#include <vector>

#include "options.h"
#include "usage_error.h"

namespace facemap::program {

/// A value that an option got, on the command line or in a scene file.
struct Word {
  std::string name;   ///< the option's long name without dashes: "size"
  std::string text;   ///< "" for a switch
  std::string place;  ///< "file:line:column" in a scene file; empty: the command line
};
using Words = std::vector<Word>;

/// The option's name without dashes.
std::string plain_name(const Option& option);

bool has(const Words& words, const std::string& name);

/// All of `first`, and those of `second` whose options are not in `first`.
Words merge(const Words& first, const Words& second);

/// The same for words about cameras and pictures: where `first` names a lens, nothing of the lens in `second` counts; a
/// crop hides a tile and a tile a crop; a pose hides place, target and up.
Words merge_cameras(const Words& first, const Words& second);

/// The same rows, whose values are kept in `words` beside being set. `words` must outlive them.
std::vector<Option> recorded(std::vector<Option> options, Words& words);

/// Sets options by their words. Throws UsageError, or Error with the place of a word of a scene file.
void set_options(const std::vector<Option>& options, const Words& words);

/// Throws Error if `message` names flags of `words` that all stand in a scene file.
void refuse_at_its_place(const Words& words, const std::string& message);

/// Runs what throws UsageError for flags that do not go together. If a word of a scene file is named, and none of the
/// command line, the file is at fault: Error with its place.
template <typename Run>
auto with_places(const Words& words, const Run& run) {
  try {
    return run();
  } catch (const UsageError& error) {
    refuse_at_its_place(words, error.what());
    throw;
  }
}

/// The words as flags of a command line, quoted for a shell where need be.
std::string flags_of(const Words& words);
std::string quoted_for_shell(const std::string& text);

}  // namespace facemap::program
