#include "scene/model_folder.h"

#include <algorithm>

namespace facemap {

UriResult<std::filesystem::path> find_in_folder(const std::filesystem::path& folder, std::string name,
                                                bool allow_outside) {
  std::replace(name.begin(), name.end(), '\\', '/');
  if (allow_outside) {
    UriResult<std::filesystem::path> found = find_file(folder, name, true);
    if (found.value) return found;
  }
  const std::filesystem::path path(name);
  const bool has_drive = name.size() > 1 && name[1] == ':';
  const bool leads_out = path.is_absolute() || has_drive || std::find(path.begin(), path.end(), "..") != path.end();
  return file_inside(folder, leads_out ? path.filename().string() : name);
}

}  // namespace facemap
