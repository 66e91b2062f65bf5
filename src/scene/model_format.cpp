#include "scene/model_format.h"

#include <facemap/scene_file.h>

#include <algorithm>
#include <string>

#include "scene/number.h"
#include "scene/stl.h"

namespace facemap {

namespace {

constexpr std::size_t kHead = 4096;  ///< bytes that are looked at

std::string lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

ModelFormat format_of_extension(const std::string& extension) {
  if (extension == ".obj") return ModelFormat::Obj;
  if (extension == ".gltf") return ModelFormat::GltfJson;
  if (extension == ".glb") return ModelFormat::GltfBinary;
  if (extension == ".ply") return ModelFormat::Ply;
  if (extension == ".stl") return ModelFormat::StlBinary;
  return ModelFormat::Unknown;
}

bool is_white(char c) { return is_blank(c) || c == '\n'; }

/// The word at the head of the first line that is neither empty nor a comment.
std::string_view first_word(std::string_view text) {
  while (!text.empty()) {
    const std::string_view line = text.substr(0, text.find('\n'));
    const auto begin = std::find_if_not(line.begin(), line.end(), is_white);
    const auto end = std::find_if(begin, line.end(), is_white);
    if (begin != end && *begin != '#') return {begin, end};
    text.remove_prefix(std::min(line.size() + 1, text.size()));
  }
  return {};
}

bool is_obj_statement(std::string_view word) {
  constexpr std::string_view kStatements[] = {"v", "vt", "vn", "vp", "f", "o", "g", "s", "l", "p", "mtllib", "usemtl"};
  return std::find(std::begin(kStatements), std::end(kStatements), word) != std::end(kStatements);
}

}  // namespace

bool is_scene_file(std::string_view bytes, const std::filesystem::path& extension) {
  constexpr std::string_view kTables[] = {"[settings]", "[ground]", "[[model]]", "[[camera]]",
                                          "[[light]]",  "[model]",  "[camera]",  "[light]"};
  const std::string named = lower_case(extension.string());
  if (!named.empty()) return named == ".toml";
  const std::string_view word = first_word(bytes.substr(0, kHead));
  return std::find(std::begin(kTables), std::end(kTables), word) != std::end(kTables);
}

const char* const kKnownFormats = "OBJ, glTF, PLY, STL";

ModelFormat sniff_format(std::string_view bytes, const std::filesystem::path& extension) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  std::string_view head = bytes.substr(0, kHead);
  if (head.starts_with("ply\n") || head.starts_with("ply\r")) return ModelFormat::Ply;
  if (head.starts_with("glTF")) return ModelFormat::GltfBinary;
  if (is_stl_binary_by_size(bytes)) return ModelFormat::StlBinary;
  if (head.starts_with(kByteOrderMark)) head.remove_prefix(kByteOrderMark.size());
  const std::string_view word = first_word(head);
  if (word.starts_with('{')) return ModelFormat::GltfJson;
  const ModelFormat named = format_of_extension(lower_case(extension.string()));
  // A text that says "solid ..." in its first line could only be an OBJ file that begins with a mistake.
  if (named != ModelFormat::Obj && is_stl_text(bytes)) return ModelFormat::StlText;
  // A binary STL file whose size is wrong has zeros all the same.
  const bool is_obj_text = is_obj_statement(word) && head.find('\0') == std::string_view::npos;
  if (named == ModelFormat::StlBinary && is_obj_text) return ModelFormat::Obj;
  if (named != ModelFormat::Unknown) return named;
  return is_obj_statement(word) ? ModelFormat::Obj : ModelFormat::Unknown;
}

}  // namespace facemap
