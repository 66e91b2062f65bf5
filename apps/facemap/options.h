#pragma once

#include <functional>
#include <string>
#include <vector>

namespace facemap::program {

/// One row of a command's table: the parser, --help and docs/cli.md are made from it.
struct Option {
  std::string flags;         ///< "-o,--output"; without a dash: the argument itself ("MODEL")
  std::string value;         ///< what stands for the value in the help; empty: a switch
  std::string default_text;  ///< what holds if it is not given; may be empty
  std::string help;
  std::function<void(const std::string&)> set;  ///< throws UsageError; a switch gets ""
  bool repeats = false;
  std::vector<std::string> choices = {};  ///< the words that its value may be, if they are known

  bool is_argument() const { return flags.front() != '-'; }
};

/// The flag's long name, or the argument's.
std::string name_of(const Option& option);

/// A command line that works, and what it does.
struct Example {
  std::string command;
  std::string what;
};

struct Command {
  std::string name;
  std::string summary;  ///< one line
  std::string text;     ///< a paragraph or two for --help, lines as they shall stand
  std::vector<Option> options;
  std::vector<Example> examples;
  std::function<int()> run;  ///< after all options are set; returns the exit code
};

/// An Option::set that stores what `parse` makes of the text. `field` must outlive the option.
template <typename Field, typename Parse>
std::function<void(const std::string&)> into(Field& field, Parse parse) {
  return [&field, parse](const std::string& text) { field = parse(text); };
}

/// "; did you mean X?" for the known word nearest to `word`, or nothing if none is near.
std::string suggestion(const std::string& word, const std::vector<std::string>& known);

/// Reads the words after the program's name, sets the options of the command that they name and returns it;
/// nullptr if they asked for help, the version or the like, which is then in `answer`. Throws UsageError.
const Command* parse_command_line(const std::vector<Command>& commands, int argc, const char* const* argv,
                                  std::string& answer);

}  // namespace facemap::program
