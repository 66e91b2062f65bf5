#include "completions.h"

#include <algorithm>
#include <sstream>

namespace facemap::program {
namespace {

const char* const kProgramFlags = "--help --version --help-markdown --man --completion";

std::vector<std::string> flags_of(const Option& option) {
  std::vector<std::string> flags;
  std::istringstream each(option.flags);
  for (std::string flag; std::getline(each, flag, ',');) flags.push_back(flag);
  return flags;
}

std::string joined(const std::vector<std::string>& words, const char* between) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
  return text;
}

std::string names_of(const std::vector<Command>& commands) {
  std::vector<std::string> names;
  for (const Command& command : commands) names.push_back(command.name);
  return joined(names, " ");
}

/// Whether a value is the name of a file, or has one behind its "=".
bool is_file(const Option& option) { return option.value.ends_with("FILE") || option.value == "FOLDER"; }

/// Within single quotes of a shell.
std::string quoted(const std::string& text) {
  std::string safe;
  for (const char c : text) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + safe + "'";
}

/// A description within zsh's brackets.
std::string in_brackets(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '[' || c == ']' || c == ':' || c == '\\') safe += '\\';
    safe += c;
  }
  return safe;
}

/// The first part of a help text.
std::string summary_of(const Option& option) { return option.help.substr(0, option.help.find(';')); }

/// The words that a command's argument may be, or none.
std::vector<std::string> argument_choices(const Command& command) {
  for (const Option& option : command.options) {
    if (option.is_argument()) return option.choices;
  }
  return {};
}

/// The name as a shell's pattern: what is no other command is a model's name, whose flags are those of render.
std::string pattern_of(const Command& command) { return command.name == "render" ? "*" : command.name; }

/// The same commands, the one whose pattern matches everything last.
std::vector<const Command*> render_last(const std::vector<Command>& commands) {
  std::vector<const Command*> sorted;
  for (const Command& command : commands) sorted.push_back(&command);
  std::stable_partition(sorted.begin(), sorted.end(), [](const Command* command) { return command->name != "render"; });
  return sorted;
}

std::string bash_words_of(const Command& command) {
  std::vector<std::string> flags{"--help"};
  for (const Option& option : command.options) {
    if (option.is_argument()) continue;
    for (const std::string& flag : flags_of(option)) flags.push_back(flag);
  }
  return joined(flags, " ");
}

std::string bash_case(const Command& command) {
  std::string text = "      " + pattern_of(command) + ")\n        case $before in\n";
  for (const Option& option : command.options) {
    if (option.is_argument() || (option.choices.empty() && !is_file(option))) continue;
    text += "          " + joined(flags_of(option), "|") + ") words='" + joined(option.choices, " ") + "' ;;\n";
  }
  text += "          *) case $word in -*) words='" + bash_words_of(command) + "' ;; *) words='" +
          joined(argument_choices(command), " ") + "' ;; esac ;;\n";
  return text + "        esac ;;\n";
}

std::string zsh_row(const Option& option) {
  const std::vector<std::string> flags = flags_of(option);
  std::string action;
  if (!option.choices.empty()) {
    action = ":" + option.value + ":(" + joined(option.choices, " ") + ")";
  } else if (!option.value.empty()) {
    action = ":" + in_brackets(option.value) + ":" + (is_file(option) ? "_files" : " ");
  }
  const std::string rest = quoted("[" + in_brackets(summary_of(option)) + "]" + action);
  std::string row = "        ";
  if (flags.size() > 1) {
    row += quoted(option.repeats ? "*" : "(" + joined(flags, " ") + ")") + "{" + joined(flags, ",") + "}";
  } else {
    row += quoted(option.repeats ? "*" : "") + flags.front();
  }
  return row + rest + " \\\n";
}

/// When a command's flags are offered; those of render for a model's name too.
std::string fish_condition(const Command& command, const std::vector<Command>& commands) {
  if (command.name != "render") return "__fish_seen_subcommand_from " + command.name;
  std::string others;
  for (const Command& other : commands) others += other.name == "render" ? "" : " " + other.name;
  return "not __fish_seen_subcommand_from" + others;
}

std::string fish_row(const std::string& condition, const Option& option) {
  std::string row = "complete -c facemap -n '" + condition + "'";
  for (const std::string& flag : flags_of(option)) {
    row += flag.starts_with("--") ? " -l " + flag.substr(2) : " -s " + flag.substr(1);
  }
  if (!option.choices.empty()) {
    row += " -x -a " + quoted(joined(option.choices, " "));
  } else if (is_file(option)) {
    row += " -r -F";
  } else if (!option.value.empty()) {
    row += " -x";
  }
  return row + " -d " + quoted(summary_of(option)) + "\n";
}

}  // namespace

std::string bash_completion(const std::vector<Command>& commands) {
  std::string text =
      "# bash completion of facemap: facemap --completion bash\n"
      "_facemap() {\n"
      "  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} words=''\n"
      "  COMPREPLY=()\n"
      "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
      "    words='" +
      names_of(commands) + " " + kProgramFlags +
      "'\n"
      "  else\n"
      "    case ${COMP_WORDS[1]} in\n"
      "      --completion) words='bash zsh fish' ;;\n";
  for (const Command* command : render_last(commands)) text += bash_case(*command);
  text +=
      "    esac\n"
      "  fi\n"
      "  # shellcheck disable=SC2207 # words without blanks\n"
      "  [ -z \"$words\" ] || COMPREPLY=($(compgen -W \"$words\" -- \"$word\"))\n"
      "}\n"
      "complete -o default -F _facemap facemap\n";
  return text;
}

std::string zsh_completion(const std::vector<Command>& commands) {
  std::string text =
      "#compdef facemap\n"
      "# zsh completion of facemap: facemap --completion zsh\n"
      "_facemap() {\n"
      "  local -a commands=(\n";
  for (const Command& command : commands) text += "    " + quoted(command.name + ":" + command.summary) + "\n";
  text +=
      "  )\n"
      "  if (( CURRENT == 2 )); then\n"
      "    _describe command commands\n"
      "    _files\n"
      "    return\n"
      "  fi\n"
      "  local command=$words[2]\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $command in\n";
  for (const Command* command : render_last(commands)) {
    text += "    " + pattern_of(*command) + ")\n      _arguments \\\n";
    for (const Option& option : command->options) {
      if (!option.is_argument()) text += zsh_row(option);
    }
    const std::string choices = joined(argument_choices(*command), " ");
    text += "        '--help[what the command does]' ";
    text += choices.empty() ? "'*:file:_files' ;;\n" : "'1:name:(" + choices + ")' ;;\n";
  }
  return text + "  esac\n}\n_facemap \"$@\"\n";
}

std::string fish_completion(const std::vector<Command>& commands) {
  std::string text = "# fish completion of facemap: facemap --completion fish\n";
  for (const Command& command : commands) {
    text += "complete -c facemap -n __fish_use_subcommand -a " + command.name + " -d " + quoted(command.summary) + "\n";
  }
  for (const Command& command : commands) {
    const std::string condition = fish_condition(command, commands);
    const std::string choices = joined(argument_choices(command), " ");
    if (!choices.empty()) text += "complete -c facemap -n '" + condition + "' -f -a " + quoted(choices) + "\n";
    for (const Option& option : command.options) {
      if (!option.is_argument()) text += fish_row(condition, option);
    }
  }
  return text;
}

}  // namespace facemap::program
