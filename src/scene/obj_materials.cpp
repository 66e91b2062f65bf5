#include "scene/obj_materials.h"

#include <facemap/error.h>
#include <facemap/mesh.h>

#include <algorithm>
#include <system_error>

#include "scene/file_mapping.h"
#include "scene/mtl.h"
#include "scene/number.h"

namespace facemap {

namespace {

bool ends_in_mtl(std::string_view word) {
  constexpr std::string_view kExtension = ".mtl";
  return word.size() >= kExtension.size() &&
         std::equal(kExtension.begin(), kExtension.end(), word.end() - kExtension.size(),
                    [](char a, char b) { return a == b || (a != '.' && a == (b | 0x20)); });
}

/// A name's path below the model's folder. Files elsewhere are not opened at the word of a model: of a name that
/// leads out (absolute, a drive, or with ".."), the last part is looked up beside the model.
std::filesystem::path path_inside(const std::string& name) {
  const std::filesystem::path path(name);
  const bool has_drive = name.size() > 1 && name[1] == ':';
  const bool leads_out = path.is_absolute() || has_drive || std::find(path.begin(), path.end(), "..") != path.end();
  return leads_out ? path.filename() : path;
}

/// Cuts off the head of `text` up to the first blank that is not escaped, which goes too.
std::string take_word(std::string_view& text) {
  std::string word;
  std::size_t at = 0;
  for (; at < text.size() && !is_blank(text[at]); ++at) {
    const bool is_escape = text[at] == '\\' && at + 1 < text.size() && text[at + 1] == ' ';
    if (is_escape) ++at;
    word.push_back(text[at] == '\\' ? '/' : text[at]);
  }
  text.remove_prefix(std::min(at + 1, text.size()));
  return word;
}

std::string join(const std::vector<std::string>& words) {
  std::string text = words[0];
  for (std::size_t i = 1; i < words.size(); ++i) text += " " + words[i];
  return text;
}

}  // namespace

std::vector<std::string> split_library_names(std::string_view names) {
  std::vector<std::string> result, words;
  while (!names.empty()) {
    std::string word = take_word(names);
    if (word.empty()) continue;
    words.push_back(std::move(word));
    if (ends_in_mtl(words.back())) {
      result.push_back(join(words));
      words.clear();
    }
  }
  result.insert(result.end(), words.begin(), words.end());
  return result;
}

ObjMaterials::ObjMaterials(const std::filesystem::path& directory, std::uint64_t max_bytes, bool allow_outside)
    : directory_(directory), max_bytes_(max_bytes), images_(directory, allow_outside) {}

std::uint32_t ObjMaterials::use(std::string_view name, std::int64_t line) {
  if (name.empty()) return kNoIndex;
  auto found = uses_.find(name);
  if (found == uses_.end()) {
    const auto number = static_cast<std::uint32_t>(uses_.size());
    found = uses_.emplace(std::string(name), Use{number, line}).first;
  }
  return found->second.number;
}

void ObjMaterials::read_libraries(std::string_view names, std::int64_t line, ObjWarnings& warnings) {
  if (directory_.empty()) return;
  for (const std::string& name : split_library_names(names)) read_library(name, line, warnings);
}

void ObjMaterials::read_library(const std::string& name, std::int64_t line, ObjWarnings& warnings) {
  constexpr std::size_t kMaxLibraries = 256;
  if (libraries_.size() >= kMaxLibraries) return warnings.add(line, "too many MTL files", name);
  if (!libraries_.insert(name).second) return;

  const std::filesystem::path path = directory_ / path_inside(name);
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error)) return warnings.add(line, "MTL file not found", name);
  try {
    const FileMapping file(path, max_bytes_);
    if (file.text().find('\0') != std::string_view::npos) {
      return warnings.add(line, "MTL file is not text", name);
    }
    ObjWarnings mtl_warnings(path.string());
    parse_mtl(file.text(), path.parent_path(), images_, mtl_warnings, materials_);
    mtl_warnings.append_to(mtl_warnings_);
  } catch (const LoadError& cannot_read) {
    warnings.add(line, "MTL file cannot be read", name + ": " + cannot_read.reason());
  }
}

void ObjMaterials::resolve(std::vector<std::uint32_t>& numbers, ObjWarnings& warnings) const {
  std::map<std::string_view, std::uint32_t> defined;
  for (std::size_t i = 0; i < materials_.size(); ++i) {
    defined.emplace(materials_[i].name, static_cast<std::uint32_t>(i));  // the first of a name counts
  }
  std::vector<std::uint32_t> indices(uses_.size(), kNoIndex);
  std::map<std::int64_t, std::string_view> undefined;  // by line
  for (const auto& [name, use] : uses_) {
    const auto found = defined.find(name);
    if (found != defined.end()) {
      indices[use.number] = found->second;
    } else {
      undefined.emplace(use.first_line, name);
    }
  }
  for (const auto& [line, name] : undefined) warnings.add(line, "material not defined", name);

  for (std::uint32_t& number : numbers) {
    if (number != kNoIndex) number = indices[number];
  }
  if (std::all_of(numbers.begin(), numbers.end(), [](std::uint32_t index) { return index == kNoIndex; })) {
    numbers.clear();
  }
}

}  // namespace facemap
