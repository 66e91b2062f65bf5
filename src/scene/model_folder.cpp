#include "scene/model_folder.h"

#include <algorithm>
#include <system_error>

#include "scene/obj_lines.h"

namespace facemap {

namespace fs = std::filesystem;

namespace {

fs::path path_inside(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  const fs::path path(name);
  const bool has_drive = name.size() > 1 && name[1] == ':';
  const bool leads_out = path.is_absolute() || has_drive || std::find(path.begin(), path.end(), "..") != path.end();
  return leads_out ? path.filename() : path;
}

bool is_below(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

}  // namespace

std::string find_in_folder(const fs::path& folder, const std::string& name, fs::path& found) {
  const std::string shown = "\"" + printable(name) + "\"";
  if (folder.empty()) return shown + " is not looked for: the model has no folder";
  if (name.find('\0') != std::string::npos) return shown + " has a NUL byte";
  std::error_code error;
  const fs::path top = fs::canonical(folder, error);
  if (error) return "the model's folder is not there";
  const fs::path path = fs::canonical(top / path_inside(name), error);
  if (error || !fs::is_regular_file(path, error)) return shown + " is not found";
  if (!is_below(path, top)) return shown + " is a link out of the model's folder";
  found = path;
  return {};
}

}  // namespace facemap
