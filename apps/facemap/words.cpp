#include "words.h"

#include <facemap/error.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>

namespace facemap::program {
namespace {

[[noreturn]] void refuse(const Word& word, const std::string& reason) {
  if (word.place.empty()) throw UsageError("--" + word.name + ": " + reason);
  throw Error(word.place + ": " + word.name + ": " + reason);
}

/// A switch stands alone on a command line; in a scene file it is true or false.
void set_switch(const Option& option, const Word& word) {
  if (word.text != "" && word.text != "on" && word.text != "off") refuse(word, "is not true or false");
  if (word.text != "off") option.set("");
}

/// What says which lens a camera has, or means something for one lens alone.
bool is_lens_word(const std::string& name) {
  constexpr std::array kNames = {"lens",          "projection", "field-angle",  "cube-layout",
                                 "camera-matrix", "distortion", "ortho-height", "opencv-pose"};
  return std::find(kNames.begin(), kNames.end(), name) != kNames.end();
}

/// Whether `first` says in another way what the option `name` says.
bool is_said_otherwise(const Words& first, const std::string& name) {
  if (name == "crop") return has(first, "tile");
  if (name == "tile") return has(first, "crop");
  return (name == "camera" || name == "look-at" || name == "up") && has(first, "opencv-pose");
}

/// Whether a message says --name, and not the beginning of a longer one.
bool names_flag(const std::string& message, const std::string& name) {
  const std::string flag = "--" + name;
  const auto goes_on = [&](std::size_t end) {
    return end < message.size() && (message[end] == '-' || (message[end] >= 'a' && message[end] <= 'z'));
  };
  for (std::size_t at = message.find(flag); at != std::string::npos; at = message.find(flag, at + 1)) {
    if (!goes_on(at + flag.size())) return true;
  }
  return false;
}

}  // namespace

std::string plain_name(const Option& option) {
  const std::string name = name_of(option);
  return name.starts_with("--") ? name.substr(2) : name;
}

bool has(const Words& words, const std::string& name) {
  return std::any_of(words.begin(), words.end(), [&](const Word& word) { return word.name == name; });
}

Words merge(const Words& first, const Words& second) {
  std::set<std::string> names;
  for (const Word& word : first) names.insert(word.name);
  Words all = first;
  for (const Word& word : second) {
    if (names.count(word.name) == 0) all.push_back(word);
  }
  return all;
}

Words merge_cameras(const Words& first, const Words& second) {
  const auto lens = std::find_if(first.begin(), first.end(),
                                 [](const Word& word) { return word.name == "lens" || word.name == "projection"; });
  const bool names_lens = lens != first.end();
  const bool has_angle = names_lens && (lens->text == "plane" || lens->text == "surface");
  Words rest;
  for (const Word& word : second) {
    const bool is_of_other_lens = names_lens && is_lens_word(word.name) && !(word.name == "field-angle" && has_angle);
    if (!is_of_other_lens && !is_said_otherwise(first, word.name)) rest.push_back(word);
  }
  return merge(first, rest);
}

std::vector<Option> recorded(std::vector<Option> options, Words& words) {
  for (Option& option : options) {
    const std::string name = plain_name(option);
    const auto set = option.set;
    option.set = [name, set, &words](const std::string& text) {
      set(text);
      words.push_back({name, text, ""});
    };
  }
  return options;
}

void set_options(const std::vector<Option>& options, const Words& words) {
  std::map<std::string, std::size_t> counts;
  for (const Word& word : words) ++counts[word.name];
  for (const Word& word : words) {
    const auto found =
        std::find_if(options.begin(), options.end(), [&](const Option& o) { return plain_name(o) == word.name; });
    if (found == options.end()) refuse(word, "is not known");
    if (counts[word.name] > 1 && !found->repeats) refuse(word, "is given more than once");
    try {
      if (found->value.empty() && !found->is_argument()) {
        set_switch(*found, word);
      } else {
        found->set(word.text);
      }
    } catch (const UsageError& error) {
      refuse(word, error.what());
    }
  }
}

void refuse_at_its_place(const Words& words, const std::string& message) {
  const Word* named = nullptr;
  for (const Word& word : words) {
    if (!names_flag(message, word.name)) continue;
    if (word.place.empty()) return;
    if (named == nullptr) named = &word;
  }
  if (named != nullptr) throw Error(named->place + ": " + message);
}

std::string quoted_for_shell(const std::string& text) {
  const auto is_plain = [](unsigned char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c >= 0x80 ||
           std::string_view("-_./,:=+@%").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!text.empty() && std::all_of(text.begin(), text.end(), is_plain)) return text;
  std::string safe;
  for (const char c : text) safe += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return "'" + safe + "'";
}

std::string flags_of(const Words& words) {
  std::string flags;
  for (const Word& word : words) {
    flags += (flags.empty() ? "--" : " --") + word.name;
    if (!word.text.empty()) flags += " " + quoted_for_shell(word.text);
  }
  return flags;
}

}  // namespace facemap::program
