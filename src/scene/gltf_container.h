#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace facemap {

/// The two parts of a glTF file's bytes, which must outlive this.
struct GltfContainer {
  std::string_view json;
  std::optional<std::string_view> binary;  ///< of a GLB file: the first buffer's bytes, with padding

  /// Of a JSON file or a GLB file, told by its first bytes. Throws LoadError: Unsupported, TruncatedStatement,
  /// BadSyntax, BadEncoding.
  static GltfContainer open(std::string_view bytes, const std::string& name);
};

}  // namespace facemap
