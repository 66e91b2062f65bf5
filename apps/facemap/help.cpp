#include "help.h"

#include <algorithm>
#include <sstream>

namespace facemap::program {
namespace {

constexpr std::size_t kLineWidth = 100;
constexpr std::size_t kHelpColumn = 32;

/// Words of `text` in lines of kLineWidth, each but the first indented to kHelpColumn.
std::string wrap(const std::string& text) {
  std::istringstream words(text);
  std::string lines, word;
  std::size_t column = kHelpColumn;
  while (words >> word) {
    if (column > kHelpColumn && column + 1 + word.size() > kLineWidth) {
      lines += "\n" + std::string(kHelpColumn, ' ');
      column = kHelpColumn;
    } else if (column > kHelpColumn) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += word.size();
  }
  return lines + "\n";
}

std::string option_row(const Option& option) {
  std::string left = "  ";
  if (!option.is_argument() && option.flags.starts_with("--")) left += "    ";
  left += option.flags;
  const std::size_t comma = left.find(',');
  if (comma != std::string::npos) left.insert(comma + 1, " ");
  if (!option.value.empty()) left += " " + option.value;
  std::string help = option.help;
  if (!option.default_text.empty()) help += " [" + option.default_text + "]";
  if (left.size() + 2 > kHelpColumn) return left + "\n" + std::string(kHelpColumn, ' ') + wrap(help);
  return left + std::string(kHelpColumn - left.size(), ' ') + wrap(help);
}

std::string usage_line(const Command& command) {
  std::string line = "facemap " + command.name;
  for (const Option& option : command.options) {
    if (option.is_argument()) line += " " + option.flags + (option.repeats ? "..." : "");
  }
  const bool writes = std::any_of(command.options.begin(), command.options.end(),
                                  [](const Option& option) { return option.flags.starts_with("-o"); });
  if (writes) line += " -o FILE";
  return line + " [options]";
}

}  // namespace

std::string program_help(const std::vector<Command>& commands) {
  std::string text =
      "facemap draws 3D models with exact visibility and shadows, on the CPU alone.\n"
      "The same command gives the same pixels on every machine.\n"
      "\n"
      "Usage: facemap COMMAND [options]\n"
      "       facemap MODEL [options of facemap render]    a picture to show, with ground and lights\n"
      "\n"
      "Commands:\n";
  for (const Command& command : commands) {
    text += "  " + command.name + std::string(12 - command.name.size(), ' ') + command.summary + "\n";
  }
  text +=
      "\n"
      "  facemap COMMAND --help    what a command does, its options, examples\n"
      "  facemap --version         the version\n"
      "  facemap --help-markdown   all of this as a page (docs/cli.md)\n"
      "  facemap --man             all of this as a manual page\n"
      "  facemap --completion SHELL  completions for bash, zsh or fish\n"
      "\n"
      "The environment variable FACEMAP_TARGET names the instruction set to use: scalar, sse4, avx2 or avx512.\n"
      "Without it the processor's best is used. Pictures are the same.\n"
      "\n"
      "Exit code: 0 done, 1 a file or a scene is at fault or pictures differ, 2 the command line is at fault,\n"
      "128 + N ended by signal N.\n";
  return text;
}

std::string command_help(const Command& command) {
  std::string text = command.summary + ".\n\nUsage: " + usage_line(command) + "\n\n" + command.text + "\nOptions:\n";
  for (const Option& option : command.options) text += option_row(option);
  text += "\nExamples:\n";
  for (const Example& example : command.examples) text += "  " + example.command + "\n      " + example.what + "\n";
  return text;
}

std::string markdown_help(const std::vector<Command>& commands) {
  std::string page =
      "# The facemap program\n"
      "\n"
      "This page is what `facemap --help-markdown` prints; a test compares the two.\n"
      "\n"
      "```text\n" +
      program_help(commands) + "```\n";
  for (const Command& command : commands) {
    page += "\n## facemap " + command.name + "\n\n```text\n" + command_help(command) + "```\n";
  }
  return page;
}

}  // namespace facemap::program
