#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace facemap {

/// Finds the files that a model names, as people have them: with Windows' backslashes, quotes, other upper and lower
/// case, folders of another machine.
///
/// Files elsewhere are not opened at the word of a model: what is found lies in the model's folder or its folders,
/// symbolic links followed, unless others are allowed.
class TextureFiles {
 public:
  TextureFiles(std::filesystem::path model_folder, bool allow_outside);

  enum class Outcome { Found, Missing, Outside };
  struct Found {
    Outcome outcome = Outcome::Missing;
    std::filesystem::path path;
  };

  /// Looks for `name` from `folder` on (where the file lies that names it): as it stands, then whatever its case, then
  /// its last part alone. `Outside`: it is there, but may not be opened.
  Found find(const std::filesystem::path& folder, std::string_view name);

 private:
  Found look(const std::filesystem::path& folder, const std::filesystem::path& name);
  std::filesystem::path in_any_case(std::filesystem::path folder, const std::filesystem::path& name);
  bool is_inside(const std::filesystem::path& file) const;

  std::filesystem::path model_folder_;
  bool allow_outside_;
  /// A folder's files by their names in lower case.
  std::map<std::filesystem::path, std::map<std::string, std::filesystem::path>> listings_;
};

/// `name` with slashes for backslashes, without quotes around it and without blanks at its ends.
std::filesystem::path portable_name(std::string_view name);

}  // namespace facemap
