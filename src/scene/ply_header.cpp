#include "scene/ply_header.h"

#include <facemap/error.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>
#include <utility>

#include "scene/obj_lines.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;

constexpr std::size_t kMostProperties = 4096;  ///< of all elements, and as many elements: more is hostile

struct TypeName {
  std::string_view name;
  PlyType type;
};

constexpr std::array<TypeName, 16> kTypeNames = {{{"char", PlyType::Int8},
                                                  {"int8", PlyType::Int8},
                                                  {"uchar", PlyType::UInt8},
                                                  {"uint8", PlyType::UInt8},
                                                  {"short", PlyType::Int16},
                                                  {"int16", PlyType::Int16},
                                                  {"ushort", PlyType::UInt16},
                                                  {"uint16", PlyType::UInt16},
                                                  {"int", PlyType::Int32},
                                                  {"int32", PlyType::Int32},
                                                  {"uint", PlyType::UInt32},
                                                  {"uint32", PlyType::UInt32},
                                                  {"float", PlyType::Float32},
                                                  {"float32", PlyType::Float32},
                                                  {"double", PlyType::Float64},
                                                  {"float64", PlyType::Float64}}};

bool is_header_blank(char c) { return c == ' ' || c == '\t'; }

/// Takes the next word off `line`; empty at its end.
std::string_view take_word(std::string_view& line) {
  const auto begin = std::find_if_not(line.begin(), line.end(), is_header_blank);
  const auto end = std::find_if(begin, line.end(), is_header_blank);
  const std::string_view word(begin, end);
  line = std::string_view(end, line.end());
  return word;
}

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_header_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_header_blank(text.back())) text.remove_suffix(1);
  return text;
}

class HeaderReader {
 public:
  HeaderReader(std::string_view bytes, const std::string& name, ObjWarnings& warnings)
      : bytes_(bytes), name_(name), warnings_(warnings) {}

  PlyHeader read() {
    if (take_line() != "ply") fail(Cause::UnknownFormat, "not a PLY file: it does not begin with \"ply\"");
    while (read_statement()) {
    }
    if (!has_format_) fail(Cause::TruncatedStatement, "the header states no format");
    header_.size = at_;
    header_.lines = line_;
    return std::move(header_);
  }

 private:
  /// The next line without its end and blanks.
  std::string_view take_line() {
    const std::size_t end = bytes_.find('\n', at_);
    ++line_;
    if (end == std::string_view::npos) {
      if (bytes_.find('\r', at_) != std::string_view::npos) {
        fail(Cause::BadEncoding, "lines end in carriage returns alone");
      }
      fail(Cause::TruncatedStatement, "the file ends in its header");
    }
    std::string_view line = bytes_.substr(at_, end - at_);
    at_ = end + 1;
    if (line.ends_with('\r')) line.remove_suffix(1);
    return trimmed(line);
  }

  /// False after end_header.
  bool read_statement() {
    std::string_view line = take_line();
    const std::string_view keyword = take_word(line);
    if (keyword == "end_header") return false;
    if (keyword == "format") {
      read_format(line);
    } else if (keyword == "element") {
      read_element(line);
    } else if (keyword == "property") {
      read_property(line);
    } else if (keyword == "comment") {
      read_comment(line);
    } else if (keyword != "obj_info" && !keyword.empty()) {
      warnings_.add(line_, "unknown statement in the header, ignored", keyword);
    }
    return true;
  }

  void read_format(std::string_view line) {
    const std::string_view format = take_word(line), version = take_word(line);
    if (format == "ascii") {
      header_.format = PlyFormat::Text;
    } else if (format == "binary_little_endian") {
      header_.format = PlyFormat::LittleEndian;
    } else if (format == "binary_big_endian") {
      header_.format = PlyFormat::BigEndian;
    } else {
      fail(Cause::UnknownFormat,
           "unknown format " + quoted(format) + "; known: ascii, binary_little_endian, binary_big_endian");
    }
    if (version != "1.0") warnings_.add(line_, "not version 1.0, read as if it were", version);
    has_format_ = true;
  }

  void read_element(std::string_view line) {
    PlyElement element;
    element.name = take_word(line);
    const std::string_view count = take_word(line);
    const auto [end, error] = std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (count.empty()) fail(Cause::TruncatedStatement, "element without a name and a count");
    if (error != std::errc() || end != count.data() + count.size()) {
      fail(Cause::BadNumber, "not a count: " + quoted(count));
    }
    if (header_.find(element.name) != nullptr) {
      fail(Cause::UnknownFormat, "element " + quoted(element.name) + " is declared twice");
    }
    count_declaration();
    header_.elements.push_back(std::move(element));
  }

  void read_property(std::string_view line) {
    if (header_.elements.empty()) fail(Cause::UnknownFormat, "property before any element");
    PlyProperty property;
    std::string_view type = take_word(line);
    property.is_list = type == "list";
    if (property.is_list) {
      property.count_type = type_of(take_word(line));
      if (!is_whole(property.count_type)) fail(Cause::UnknownFormat, "a list's length must be a whole number");
      type = take_word(line);
    }
    property.type = type_of(type);
    property.name = take_word(line);
    if (property.name.empty()) fail(Cause::TruncatedStatement, "property without a name");
    count_declaration();
    header_.elements.back().properties.push_back(std::move(property));
  }

  void read_comment(std::string_view line) {
    if (take_word(line) != "TextureFile") return;
    const std::string_view file = trimmed(line);
    count_declaration();
    if (!file.empty()) header_.texture_files.emplace_back(file);
  }

  PlyType type_of(std::string_view word) const {
    for (const TypeName& known : kTypeNames) {
      if (known.name == word) return known.type;
    }
    if (word.empty()) fail(Cause::TruncatedStatement, "property without a type");
    fail(Cause::UnknownFormat, "unknown type " + quoted(word));
  }

  void count_declaration() {
    if (++declarations_ > kMostProperties) {
      fail(Cause::TooLarge, "more than " + std::to_string(kMostProperties) + " elements and properties");
    }
  }

  static std::string quoted(std::string_view text) { return "\"" + printable(text) + "\""; }

  [[noreturn]] void fail(Cause cause, const std::string& reason) const { throw LoadError(cause, name_, line_, reason); }

  std::string_view bytes_;
  const std::string& name_;
  ObjWarnings& warnings_;
  PlyHeader header_;
  std::size_t at_ = 0;
  std::int64_t line_ = 0;
  std::size_t declarations_ = 0;
  bool has_format_ = false;
};

}  // namespace

std::size_t size_of(PlyType type) {
  switch (type) {
    case PlyType::Int8:
    case PlyType::UInt8:
      return 1;
    case PlyType::Int16:
    case PlyType::UInt16:
      return 2;
    case PlyType::Int32:
    case PlyType::UInt32:
    case PlyType::Float32:
      return 4;
    case PlyType::Float64:
      break;
  }
  return 8;
}

bool is_whole(PlyType type) { return type != PlyType::Float32 && type != PlyType::Float64; }

std::size_t PlyElement::find(std::string_view property) const {
  const auto found =
      std::find_if(properties.begin(), properties.end(), [&](const PlyProperty& p) { return p.name == property; });
  return found == properties.end() ? kNoProperty : static_cast<std::size_t>(found - properties.begin());
}

bool PlyElement::has_lists() const {
  return std::any_of(properties.begin(), properties.end(), [](const PlyProperty& p) { return p.is_list; });
}

std::size_t PlyElement::least_row_size() const {
  std::size_t size = 0;
  for (const PlyProperty& property : properties)
    size += size_of(property.is_list ? property.count_type : property.type);
  return size;
}

const PlyElement* PlyHeader::find(std::string_view element) const {
  for (const PlyElement& known : elements) {
    if (known.name == element) return &known;
  }
  return nullptr;
}

PlyHeader read_ply_header(std::string_view bytes, const std::string& name, ObjWarnings& warnings) {
  return HeaderReader(bytes, name, warnings).read();
}

}  // namespace facemap
