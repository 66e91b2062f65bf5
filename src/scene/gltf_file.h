#pragma once

#include <facemap/model.h>

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "scene/gltf_value.h"
#include "scene/obj_warnings.h"

namespace facemap {

/// What every part of the glTF reader needs of a file. All that it points to must outlive it.
struct GltfFile {
  GltfValue root;                          ///< the JSON text's value
  std::optional<std::string_view> binary;  ///< GLB: the first buffer's bytes
  std::size_t size;                        ///< bytes of the file itself
  const std::filesystem::path& directory;  ///< external files are below it
  const ModelLimits& limits;
  ObjWarnings& warnings;

  /// Notes an oddity, and the first place that has it. `cause` is a literal.
  void warn(const GltfValue& place, const char* cause) const { warnings.add(0, cause, place.path()); }
};

/// Throws LoadError if the file is of another version, or requires an extension that is not read; warns of the
/// extensions that are ignored.
void check_gltf_version(const GltfFile& file);

}  // namespace facemap
