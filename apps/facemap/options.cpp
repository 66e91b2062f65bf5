#include "options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>

#include "completions.h"
#include "help.h"
#include "man_page.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

/// The words that followed each option, as typed.
using Words = std::map<const Option*, std::vector<std::string>>;

void add_to_parser(const Option& option, CLI::App& parser, Words& words) {
  if (option.value.empty() && !option.is_argument()) {
    parser.add_flag_callback(option.flags, [&option, &words] { words[&option].emplace_back(); });
  } else {
    // One word each time the flag stands there: a list of words would swallow the model's name.
    CLI::Option* const added = parser.add_option(option.flags, words[&option])->allow_extra_args(false);
    if (option.is_argument() && !option.repeats) added->expected(1);
    if (option.is_argument() && option.repeats)
      added->allow_extra_args()->expected(1, CLI::detail::expected_max_vector_size);
  }
}

/// Number of letters to insert, drop or replace to get from one word to the other.
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t replaced = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
      diagonal = row[j];
      row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
    }
  }
  return row[b.size()];
}

std::vector<std::string> long_flags(const Command& command) {
  std::vector<std::string> flags{"--help"};
  for (const Option& option : command.options) {
    const std::size_t start = option.flags.find("--");
    if (start != std::string::npos) flags.push_back(option.flags.substr(start));
  }
  return flags;
}

[[noreturn]] void refuse_word(const Command& command, const std::string& word) {
  const std::string hint = "\nTry 'facemap " + command.name + " --help'.";
  if (!word.starts_with('-')) throw UsageError("unexpected argument '" + word + "'" + hint);
  const std::string flag = word.substr(0, word.find('='));
  throw UsageError("unknown option " + flag + suggestion(flag, long_flags(command)) + hint);
}

/// Whether the first word is a model's name rather than a command's: then it is drawn in the studio.
bool names_model(const std::string& word) {
  if (word == "-") return true;
  if (word.starts_with('-')) return false;
  std::error_code ignored;
  return word.find_first_of("./") != std::string::npos || std::filesystem::is_regular_file(word, ignored);
}

[[noreturn]] void refuse_command(const std::vector<Command>& commands, const std::string& word) {
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.name);
  std::string hint = suggestion(word, names);
  throw UsageError("unknown " + std::string(word.starts_with('-') ? "option " : "command ") + word + hint +
                   "\nTry 'facemap --help'.");
}

void set_options(const Command& command, const Words& words) {
  for (const Option& option : command.options) {
    const auto found = words.find(&option);
    if (found == words.end()) continue;
    const std::string name = name_of(option);
    if (found->second.size() > 1 && !option.repeats) throw UsageError(name + " is given more than once");
    for (const std::string& word : found->second) {
      try {
        option.set(word);
      } catch (const UsageError& error) {
        throw UsageError(name + ": " + error.what());
      }
    }
  }
}

/// The words, with -oFILE for -o=FILE, which a parser would take as a file named =FILE.
std::vector<std::string> without_equals(const Command& command, int argc, const char* const* argv) {
  std::vector<std::string> words(argv, argv + argc);
  for (std::string& word : words) {
    if (word == "--") break;
    const bool is_short = word.size() > 3 && word[0] == '-' && word[1] != '-' && word[2] == '=';
    if (!is_short) continue;
    for (const Option& option : command.options) {
      if (!option.value.empty() && option.flags.starts_with(word.substr(0, 2) + ",")) word.erase(2, 1);
    }
  }
  return words;
}

void parse_options(const Command& command, int argc, const char* const* argv) {
  Words words;
  CLI::App parser;
  parser.set_help_flag();
  parser.allow_extras();
  for (const Option& option : command.options) add_to_parser(option, parser, words);
  const std::vector<std::string> separated = without_equals(command, argc, argv);
  std::vector<const char*> pointers;
  for (const std::string& word : separated) pointers.push_back(word.c_str());
  try {
    parser.parse(argc, pointers.data());
  } catch (const CLI::ParseError& error) {
    throw UsageError(error.what());
  }
  for (const std::string& word : parser.remaining()) {
    if (word != "--") refuse_word(command, word);
  }
  set_options(command, words);
}

bool asks_for_help(const std::string& word) { return word == "--help" || word == "-h"; }

std::string completion_for(const std::vector<std::string>& words, const std::vector<Command>& commands) {
  if (words.size() == 2 && words[1] == "bash") return bash_completion(commands);
  if (words.size() == 2 && words[1] == "zsh") return zsh_completion(commands);
  if (words.size() == 2 && words[1] == "fish") return fish_completion(commands);
  throw UsageError("--completion: name a shell: bash, zsh or fish");
}

/// facemap MODEL ... is facemap render MODEL --studio ...
void parse_studio(const Command& render, int argc, const char* const* argv) {
  std::vector<const char*> words(argv, argv + argc);
  words.insert(words.begin() + 2, "--studio");
  parse_options(render, static_cast<int>(words.size()), words.data());
}

const Command& command_named(const std::vector<Command>& commands, const std::string& name) {
  return *std::find_if(commands.begin(), commands.end(), [&](const Command& command) { return command.name == name; });
}

}  // namespace

std::string suggestion(const std::string& word, const std::vector<std::string>& known) {
  constexpr std::size_t kNear = 3;
  std::size_t best = kNear + 1;
  std::string nearest;
  for (const std::string& candidate : known) {
    const bool is_beginning = word.size() > 3 && candidate.starts_with(word);
    const std::size_t distance = is_beginning ? 0 : edit_distance(word, candidate);
    if (distance < best && distance < candidate.size() / 2) {
      best = distance;
      nearest = candidate;
    }
  }
  return nearest.empty() ? "" : "; did you mean " + nearest + "?";
}

std::string name_of(const Option& option) { return option.flags.substr(option.flags.find(',') + 1); }

const Command* parse_command_line(const std::vector<Command>& commands, int argc, const char* const* argv,
                                  std::string& answer) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  if (words.empty()) throw UsageError("no command is given\n\n" + program_help(commands));
  if (asks_for_help(words[0])) {
    answer = program_help(commands);
  } else if (words[0] == "--version") {
    answer = "facemap " FACEMAP_VERSION "\n";
  } else if (words[0] == "--help-markdown") {
    answer = markdown_help(commands);
  } else if (words[0] == "--man") {
    answer = man_page(commands);
  } else if (words[0] == "--completion") {
    answer = completion_for(words, commands);
  } else {
    const auto command =
        std::find_if(commands.begin(), commands.end(), [&](const Command& c) { return c.name == words[0]; });
    const bool is_studio = command == commands.end() && names_model(words[0]);
    if (command == commands.end() && !is_studio) refuse_command(commands, words[0]);
    const Command& asked = is_studio ? command_named(commands, "render") : *command;
    if (std::none_of(words.begin() + 1, words.end(), asks_for_help)) {
      if (is_studio) {
        parse_studio(asked, argc, argv);
      } else {
        parse_options(asked, argc - 1, argv + 1);
      }
      return &asked;
    }
    answer = command_help(asked);
  }
  return nullptr;
}

}  // namespace facemap::program
