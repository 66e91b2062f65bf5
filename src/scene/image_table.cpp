#include "scene/image_table.h"

#include <utility>

namespace facemap {
namespace {

// Images of one model: each takes memory and a look at the disk.
constexpr std::size_t kMostImages = 4096;

}  // namespace

ImageTable::ImageTable(const std::filesystem::path& model_folder, bool allow_outside)
    : has_files_(!model_folder.empty()), files_(model_folder, allow_outside) {}

std::uint32_t ImageTable::add(const std::filesystem::path& folder, std::string_view name, std::int64_t line,
                              ObjWarnings& warnings) {
  if (images_.size() >= kMostImages) {
    warnings.add(line, "too many textures", name);
    return kNoIndex;
  }
  if (!has_files_) return number_of(portable_name(name), name);
  TextureFiles::Found found = files_.find(folder, name);
  switch (found.outcome) {
    case TextureFiles::Outcome::Found:
      return number_of(found.path, name);
    case TextureFiles::Outcome::Missing:
      warnings.add(line, "texture not found", name);
      break;
    case TextureFiles::Outcome::Outside:
      warnings.add(line, "texture lies outside the model's folder", name);
      break;
  }
  return kNoIndex;
}

std::uint32_t ImageTable::number_of(const std::filesystem::path& path, std::string_view name) {
  const auto [found, is_new] = numbers_.emplace(path, static_cast<std::uint32_t>(images_.size()));
  if (is_new) images_.push_back({std::string(name), path, {}});
  return found->second;
}

}  // namespace facemap
