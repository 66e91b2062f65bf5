#include "scene/texture_files.h"

#include <algorithm>
#include <system_error>
#include <utility>

namespace facemap {
namespace {

namespace fs = std::filesystem;

// Files of a folder that are looked through for a name of another case; folders beyond that are no model's.
constexpr std::size_t kMostListed = 1 << 16;

std::string in_lower_case(std::string text) {
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

bool has_drive(const fs::path& path) {
  const std::string& text = path.native();
  return text.size() > 1 && text[1] == ':';
}

std::map<std::string, fs::path> list_of(const fs::path& folder) {
  std::map<std::string, fs::path> result;
  std::error_code error;
  fs::directory_iterator entry(folder, error);
  for (std::size_t count = 0; !error && entry != fs::directory_iterator() && count < kMostListed; ++count) {
    const fs::path name = entry->path().filename();
    const auto [found, is_new] = result.emplace(in_lower_case(name.string()), name);
    // Of names that differ in case alone the first counts, however the folder lists them.
    if (!is_new) found->second = std::min(found->second, name);
    entry.increment(error);
  }
  return result;
}

}  // namespace

fs::path portable_name(std::string_view name) {
  const auto is_trimmed = [](char c) { return c == ' ' || c == '\t' || c == '\r' || c == '"'; };
  while (!name.empty() && is_trimmed(name.front())) name.remove_prefix(1);
  while (!name.empty() && is_trimmed(name.back())) name.remove_suffix(1);
  std::string text(name);
  std::replace(text.begin(), text.end(), '\\', '/');
  return text;
}

TextureFiles::TextureFiles(fs::path model_folder, bool allow_outside)
    : model_folder_(std::move(model_folder)), allow_outside_(allow_outside) {}

TextureFiles::Found TextureFiles::find(const fs::path& folder, std::string_view text) {
  const fs::path name = portable_name(text);
  if (name.empty() || name.native().find('\0') != std::string::npos) return {};
  const Found whole = look(folder, name);
  if (whole.outcome == Outcome::Found || !name.has_parent_path()) return whole;
  const Found last = look(folder, name.filename());
  return last.outcome == Outcome::Found ? last : whole;
}

TextureFiles::Found TextureFiles::look(const fs::path& folder, const fs::path& name) {
  if (name.empty()) return {};
  // Names of files elsewhere are not even tried: whether they are there is nobody's business.
  const fs::path plain = (folder / name).lexically_normal();
  const fs::path from_model = plain.lexically_relative(model_folder_.lexically_normal());
  const bool leads_out = has_drive(name) || from_model.empty() || *from_model.begin() == "..";
  if (leads_out && !allow_outside_) return {Outcome::Outside, {}};
  fs::path path = folder / name;
  if (!is_file(path)) path = in_any_case(folder, name);
  if (path.empty()) return {};
  if (!allow_outside_ && !is_inside(path)) return {Outcome::Outside, {}};
  return {Outcome::Found, std::move(path)};
}

// The file, part by part of its name; empty if there is none.
fs::path TextureFiles::in_any_case(fs::path folder, const fs::path& name) {
  for (const fs::path& part : name.relative_path()) {
    if (part == "." || part == "..") {
      folder /= part;
      continue;
    }
    auto listing = listings_.find(folder);
    if (listing == listings_.end()) listing = listings_.emplace(folder, list_of(folder)).first;
    const auto found = listing->second.find(in_lower_case(part.string()));
    if (found == listing->second.end()) return {};
    folder /= found->second;
  }
  return is_file(folder) ? folder : fs::path();
}

bool TextureFiles::is_inside(const fs::path& file) const {
  std::error_code error;
  const fs::path root = fs::canonical(model_folder_.empty() ? "." : model_folder_, error);
  if (error) return false;
  const fs::path target = fs::canonical(file, error);
  if (error) return false;
  return std::mismatch(root.begin(), root.end(), target.begin(), target.end()).first == root.end();
}

}  // namespace facemap
