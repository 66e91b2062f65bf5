#include "scene/toml_file.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <utility>

#include "scene/nearest_name.h"
#include "scene/scene_numbers.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;

constexpr std::ptrdiff_t kMostDotsInLine = 200;  ///< each may open a table, and tables are closed by recursion

constexpr std::size_t kMostSettings = 1000;  ///< of a table, and values of each: every option is far from it

/// Keys of very many parts would nest tables deeper than a stack can close them.
void check_dots(std::string_view text, const std::string& name) {
  std::int64_t line = 1;
  while (!text.empty()) {
    const std::string_view row = text.substr(0, text.find('\n'));
    if (std::count(row.begin(), row.end(), '.') > kMostDotsInLine) {
      throw LoadError(Cause::Unsupported, name, line,
                      "more than " + std::to_string(kMostDotsInLine) + " dots in a line");
    }
    text.remove_prefix(std::min(row.size() + 1, text.size()));
    ++line;
  }
}

toml::table parse(std::string_view text, const std::string& name) {
  check_dots(text, name);
  try {
    return toml::parse(text);
  } catch (const toml::parse_error& error) {
    const toml::source_position at = error.source().begin;
    throw LoadError(Cause::BadSyntax, name, at.line, std::string(error.description()), at.column);
  } catch (const Error& error) {
    throw LoadError(Cause::BadSyntax, name, 0, error.what());
  }
}

[[noreturn]] void fail_at(const std::string& name, const toml::source_region& source, Cause cause,
                          const std::string& reason) {
  throw LoadError(cause, name, source.begin.line, reason, source.begin.column);
}

const char* kind_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "an array";
    case toml::node_type::string:
      return "a text";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "true or false";
    default:
      return "a date or time";
  }
}

}  // namespace

void refuse_toml() { throw Error("is not TOML"); }

TomlFile::TomlFile(std::string_view text, std::string name) : name_(std::move(name)), root_(parse(text, name_)) {}

void TomlFile::fail(const toml::node& node, Cause cause, const std::string& reason) const {
  fail_at(name_, node.source(), cause, reason);
}

void TomlFile::fail(const toml::key& key, Cause cause, const std::string& reason) const {
  fail_at(name_, key.source(), cause, reason);
}

void TomlFile::check_keys(const toml::table& table, const std::string& what,
                          const std::vector<std::string>& known) const {
  for (const auto& [key, node] : table) {
    const std::string name(key.str());
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    fail(key, Cause::BadValue,
         "unknown key \"" + name + "\" in " + what + name_suggestion(name, known) + " (known: " + name_list(known) +
             ")");
  }
}

std::vector<const toml::table*> TomlFile::tables(const toml::table& parent, const std::string& key) const {
  const toml::node* const node = parent.get(key);
  if (node == nullptr) return {};
  if (node->is_table()) return {node->as_table()};
  std::vector<const toml::table*> tables;
  if (!node->is_array()) fail(*node, Cause::BadValue, key + " is " + kind_of(*node) + ", not a table [[" + key + "]]");
  for (const toml::node& element : *node->as_array()) {
    if (!element.is_table()) fail(element, Cause::BadValue, std::string("is ") + kind_of(element) + ", not a table");
    tables.push_back(element.as_table());
  }
  return tables;
}

double TomlFile::number(const toml::node& node) const {
  if (!node.is_number()) fail(node, Cause::BadValue, std::string("is ") + kind_of(node) + ", not a number");
  const double value =
      node.is_integer() ? static_cast<double>(node.as_integer()->get()) : node.as_floating_point()->get();
  if (!std::isfinite(value)) fail(node, Cause::BadNumber, "is not a finite number");
  return value;
}

double TomlFile::positive(const toml::node& node) const {
  const double value = number(node);
  if (!(value > 0)) fail(node, Cause::BadValue, "is not above 0");
  return value;
}

float TomlFile::real(const toml::node& node) const {
  const std::optional<float> value = nearest_float(number(node));
  if (!value) fail(node, Cause::BadNumber, "is too large for a float");
  return *value;
}

std::string TomlFile::text(const toml::node& node) const {
  if (!node.is_string()) fail(node, Cause::BadValue, std::string("is ") + kind_of(node) + ", not a text");
  return node.as_string()->get();
}

std::vector<double> TomlFile::numbers(const toml::node& node, std::size_t count) const {
  const toml::array* const array = node.as_array();
  if (array == nullptr || array->size() != count) {
    const std::string found = array ? "an array of " + std::to_string(array->size()) : std::string(kind_of(node));
    fail(node, Cause::BadValue, "is " + found + ", not an array of " + std::to_string(count) + " numbers");
  }
  std::vector<double> values;
  for (const toml::node& element : *array) values.push_back(number(element));
  return values;
}

DVector TomlFile::wide_vector(const toml::node& node) const {
  const std::vector<double> values = numbers(node, 3);
  return {values[0], values[1], values[2]};
}

Vector TomlFile::vector(const toml::node& node) const {
  numbers(node, 3);
  const toml::array& array = *node.as_array();
  return {real(array[0]), real(array[1]), real(array[2])};
}

Vector TomlFile::direction(const toml::node& node) const {
  if (node.is_string()) {
    const std::optional<Vector> axis = axis_of(text(node));
    if (!axis) fail(node, Cause::BadValue, "is not x, y, z, -x, -y, -z or an array of 3 numbers");
    return *axis;
  }
  const Vector direction = vector(node);
  if (direction == Vector(0)) fail(node, Cause::BadValue, "has no direction");
  return direction;
}

Color TomlFile::color(const toml::node& node) const {
  if (!node.is_string()) {
    const Vector rgb = vector(node);
    return {rgb.x, rgb.y, rgb.z};
  }
  const std::string code = text(node);
  std::uint32_t rgb = 0;
  const char* const end = code.data() + code.size();
  const bool is_code =
      code.size() == 7 && code[0] == '#' && std::from_chars(code.data() + 1, end, rgb, 16).ptr == end && code[1] != '-';
  if (!is_code) fail(node, Cause::BadValue, "is not a colour: \"#rrggbb\" or an array of 3 linear values");
  return Color::from_24_bit(rgb);
}

std::size_t TomlFile::choice(const toml::node& node, const std::vector<std::string>& choices) const {
  const std::string word = text(node);
  const auto found = std::find(choices.begin(), choices.end(), word);
  if (found == choices.end()) {
    fail(node, Cause::BadValue,
         "\"" + word + "\" is not known" + name_suggestion(word, choices) + " (known: " + name_list(choices) + ")");
  }
  return static_cast<std::size_t>(found - choices.begin());
}

std::string TomlFile::scalar_text(const toml::node& node) const {
  if (node.is_string()) return text(node);
  if (node.is_boolean()) return node.as_boolean()->get() ? "on" : "off";
  if (node.is_integer()) return std::to_string(node.as_integer()->get());
  if (node.is_number()) return shortest_text(number(node));
  fail(node, Cause::BadValue, std::string("is ") + kind_of(node) + ", not a text, a number or an array of them");
}

std::string TomlFile::joined_text(const toml::array& array) const {
  std::string text;
  for (const toml::node& element : array) text += (text.empty() ? "" : ",") + scalar_text(element);
  return text;
}

/// Of an array of texts or arrays one each, of all else one.
std::vector<std::string> TomlFile::texts(const toml::node& node) const {
  const toml::array* const array = node.as_array();
  if (array == nullptr) return {scalar_text(node)};
  if (array->empty()) fail(node, Cause::BadValue, "is an empty array");
  if (array->size() > kMostSettings)
    fail(node, Cause::Unsupported, "has more than " + std::to_string(kMostSettings) + " values");
  if (!(*array)[0].is_array() && !(*array)[0].is_string()) return {joined_text(*array)};
  std::vector<std::string> texts;
  for (const toml::node& element : *array) {
    texts.push_back(element.is_array() ? joined_text(*element.as_array()) : scalar_text(element));
  }
  return texts;
}

void TomlFile::add_setting(std::vector<SceneSetting>& settings, const toml::key& key, const toml::node& node) const {
  const std::string name = setting_name(key);
  const toml::source_position at = key.source().begin;
  if (settings.size() == kMostSettings)
    fail(key, Cause::Unsupported, "more than " + std::to_string(kMostSettings) + " settings");
  // The table's order is that of keys as they are spelt, with _ or -.
  const auto place = std::lower_bound(settings.begin(), settings.end(), name,
                                      [](const SceneSetting& setting, const auto& of) { return setting.name < of; });
  if (place != settings.end() && place->name == name) {
    fail(key, Cause::BadValue, "\"" + name + "\" is given more than once");
  }
  settings.insert(place, {name, texts(node), at.line, at.column});
}

std::string setting_name(const toml::key& key) {
  std::string name(key.str());
  std::replace(name.begin(), name.end(), '_', '-');
  return name;
}

}  // namespace facemap
