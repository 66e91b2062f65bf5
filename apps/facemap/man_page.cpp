#include "man_page.h"

#include <sstream>

namespace facemap::program {
namespace {

/// Text as roff prints it: no character of it is a command.
std::string escaped(const std::string& text) {
  std::string roff;
  for (const char c : text) {
    const bool begins_line = roff.empty() || roff.back() == '\n';
    if (begins_line && (c == '.' || c == '\'')) roff += "\\&";
    if (c == '\\') {
      roff += "\\e";
    } else if (c == '-') {
      roff += "\\-";
    } else {
      roff += c;
    }
  }
  return roff;
}

/// In bold.
std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

std::string flags_of(const Option& option) {
  std::string flags;
  std::istringstream each(option.flags);
  for (std::string flag; std::getline(each, flag, ',');) flags += (flags.empty() ? "" : ", ") + bold(flag);
  if (!option.value.empty()) flags += " " + italic(option.value);
  return flags;
}

std::string option_text(const Option& option) {
  std::string help = option.help;
  if (!option.default_text.empty()) help += " [" + option.default_text + "]";
  return ".TP\n" + flags_of(option) + "\n" + escaped(help) + "\n";
}

std::string command_text(const Command& command) {
  std::string text =
      ".SS facemap " + escaped(command.name) + "\n" + escaped(command.summary) + ".\n.PP\n" + escaped(command.text);
  for (const Option& option : command.options) text += option_text(option);
  for (const Example& example : command.examples) {
    text += ".PP\n.nf\n" + bold(example.command) + "\n.fi\n.RS 4\n" + escaped(example.what) + "\n.RE\n";
  }
  return text;
}

}  // namespace

std::string man_page(const std::vector<Command>& commands) {
  std::string page = ".TH FACEMAP 1 \"\" \"facemap " FACEMAP_VERSION
                     "\"\n"
                     ".SH NAME\n"
                     "facemap \\- draw 3D models with exact visibility and shadows\n"
                     ".SH SYNOPSIS\n";
  page += bold("facemap") + " \\fIMODEL\\fR [\\fIoptions of facemap render\\fR]\n.br\n";
  for (const Command& command : commands) page += bold("facemap " + command.name) + " [\\fIoptions\\fR]\n.br\n";
  page +=
      ".SH DESCRIPTION\n"
      "facemap draws 3D models on the CPU alone: no GPU and no display are needed. The same command gives the same\n"
      "pixels on every machine.\n"
      ".SH COMMANDS\n";
  for (const Command& command : commands) page += command_text(command);
  page +=
      ".SH ENVIRONMENT\n"
      ".TP\n"
      "\\fBFACEMAP_TARGET\\fR\n"
      "the instruction set to use: scalar, sse4, avx2 or avx512. Without it the processor's best is used. Pictures "
      "are\n"
      "the same.\n"
      ".SH EXIT STATUS\n"
      ".TP\n\\fB0\\fR\ndone\n"
      ".TP\n\\fB1\\fR\na file or a scene is at fault, or pictures differ\n"
      ".TP\n\\fB2\\fR\nthe command line is\n"
      ".TP\n\\fB128 + N\\fR\nended by signal N\n";
  return page;
}

}  // namespace facemap::program
