#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "scene/gltf_value.h"
#include "scene/obj_lines.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;
using Json = nlohmann::json;

constexpr std::size_t kMaxDepth = 256;  ///< of values in values; glTF's own need about ten, `extras` may need more

/// "line 3, column 7" are said of a byte; columns count bytes from 1.
struct TextPlace {
  std::int64_t line;
  std::size_t column;
};

TextPlace place_of(std::string_view text, std::size_t byte) {
  const std::string_view before = text.substr(0, std::min(byte, text.size()));
  const std::size_t line_end = before.rfind('\n');
  return {1 + std::count(before.begin(), before.end(), '\n'),
          before.size() - (line_end == std::string_view::npos ? 0 : line_end + 1) + 1};
}

/// "[json.exception.parse_error.101] parse error at line 1, column 2: syntax error while parsing value - invalid
/// literal; last read: 'x'" without what is said elsewhere, and without text from the file.
std::string plain_reason(std::string text) {
  for (const char* const end : {"] ", "parse error at line ", ": ", " - "}) {
    const std::size_t at = text.find(end);
    if (at != std::string::npos && at < 60) text.erase(0, at + std::string_view(end).size());
  }
  return text.substr(0, text.find("; last read"));
}

/// Makes a tree of what the parser finds, in place: neither it nor the parser calls itself for values in values.
class TreeBuilder final : public nlohmann::json_sax<Json> {
 public:
  bool null() override { return add(nullptr); }
  bool boolean(bool value) override { return add(value); }
  bool number_integer(number_integer_t value) override { return add(value); }
  bool number_unsigned(number_unsigned_t value) override { return add(value); }
  bool number_float(number_float_t value, const string_t&) override { return add(value); }
  bool string(string_t& value) override { return add(std::move(value)); }
  bool binary(binary_t&) override { return false; }
  bool start_object(std::size_t) override { return open(Json::object()); }
  bool start_array(std::size_t) override { return open(Json::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }

  bool key(string_t& key) override {
    // Of two members of one name the last counts.
    member_ = &(*open_.back())[std::move(key)];
    return true;
  }

  bool parse_error(std::size_t byte, const std::string&, const nlohmann::detail::exception& error) override {
    byte_ = byte;
    reason_ = plain_reason(error.what());
    return false;
  }

  Json take() { return std::move(root_); }
  bool is_too_deep() const noexcept { return is_too_deep_; }
  std::size_t byte() const noexcept { return byte_; }
  const std::string& reason() const noexcept { return reason_; }

 private:
  Json* place(Json&& value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return &root_;
    }
    Json& parent = *open_.back();
    if (parent.is_array()) {
      parent.push_back(std::move(value));
      return &parent.back();
    }
    *member_ = std::move(value);
    return member_;
  }

  template <class Value>
  bool add(Value&& value) {
    place(Json(std::forward<Value>(value)));
    return true;
  }

  bool open(Json&& value) {
    is_too_deep_ = open_.size() >= kMaxDepth;
    if (is_too_deep_) return false;
    open_.push_back(place(std::move(value)));
    return true;
  }

  bool close() {
    open_.pop_back();
    return true;
  }

  Json root_;
  std::vector<Json*> open_;  ///< the last one is being filled, so that those before it do not move
  Json* member_ = nullptr;   ///< of the last one, if that is an object: whose value comes next
  bool is_too_deep_ = false;
  std::size_t byte_ = 0;
  std::string reason_;
};

}  // namespace

nlohmann::json parse_json(std::string_view text, const std::string& name) {
  TreeBuilder tree;
  if (Json::sax_parse(text.begin(), text.end(), &tree)) return tree.take();
  if (tree.is_too_deep()) {
    throw LoadError(Cause::TooLarge, name, 0,
                    "JSON values are nested more than " + std::to_string(kMaxDepth) + " deep");
  }
  const TextPlace place = place_of(text, tree.byte() > 0 ? tree.byte() - 1 : 0);
  throw LoadError(Cause::BadSyntax, name, place.line,
                  "column " + std::to_string(place.column) + ": " + printable(tree.reason()));
}

}  // namespace facemap
