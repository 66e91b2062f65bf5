#pragma once

#include <facemap/mesh.h>
#include <facemap/texture.h>

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "scene/obj_warnings.h"
#include "scene/texture_files.h"

namespace facemap {

/// The images that a model's materials name, each file once.
class ImageTable {
 public:
  /// `model_folder`: what is empty has no files, and names stand for them (to read text without a disk).
  ImageTable(const std::filesystem::path& model_folder, bool allow_outside);

  /// The number of the image that a file in `folder` names; kNoIndex, with a warning, if there is no such file or it
  /// may not be opened.
  std::uint32_t add(const std::filesystem::path& folder, std::string_view name, std::int64_t line,
                    ObjWarnings& warnings);

  std::vector<TextureImage>& images() { return images_; }

 private:
  std::uint32_t number_of(const std::filesystem::path& path, std::string_view name);

  bool has_files_;
  TextureFiles files_;
  std::vector<TextureImage> images_;
  std::map<std::filesystem::path, std::uint32_t> numbers_;
};

}  // namespace facemap
