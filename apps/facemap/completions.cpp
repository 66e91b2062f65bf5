#include "completions.h"

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
std::string summary_of(const Option& option) { return option.help.substr(0, option.help.find_first_of(":;,")); }

std::string bash_words_of(const Command& command) {
  std::vector<std::string> flags{"--help"};
  for (const Option& option : command.options) {
    if (option.is_argument()) continue;
    for (const std::string& flag : flags_of(option)) flags.push_back(flag);
  }
  return joined(flags, " ");
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

std::string fish_row(const Command& command, const Option& option) {
  std::string row = "complete -c facemap -n '__fish_seen_subcommand_from " + command.name + "'";
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
  for (const Command& command : commands) {
    text += "      " + command.name + ")\n        case $before in\n";
    for (const Option& option : command.options) {
      if (option.choices.empty() || option.is_argument()) continue;
      text += "          " + joined(flags_of(option), "|") + ") words='" + joined(option.choices, " ") + "' ;;\n";
    }
    text += "          *) case $word in -*) words='" + bash_words_of(command) + "' ;; esac ;;\n";
    text += "        esac ;;\n";
  }
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
      "    return\n"
      "  fi\n"
      "  local command=$words[2]\n"
      "  shift words\n"
      "  (( CURRENT-- ))\n"
      "  case $command in\n";
  for (const Command& command : commands) {
    text += "    " + command.name + ")\n      _arguments \\\n";
    for (const Option& option : command.options) {
      if (!option.is_argument()) text += zsh_row(option);
    }
    text += "        '--help[what the command does]' '*:file:_files' ;;\n";
  }
  return text + "  esac\n}\n_facemap \"$@\"\n";
}

std::string fish_completion(const std::vector<Command>& commands) {
  std::string text = "# fish completion of facemap: facemap --completion fish\n";
  for (const Command& command : commands) {
    text +=
        "complete -c facemap -n __fish_use_subcommand -f -a " + command.name + " -d " + quoted(command.summary) + "\n";
  }
  for (const Command& command : commands) {
    for (const Option& option : command.options) {
      if (!option.is_argument()) text += fish_row(command, option);
    }
  }
  return text;
}

}  // namespace facemap::program
