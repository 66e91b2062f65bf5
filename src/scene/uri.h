#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace facemap {

/// Why a URI could not be followed, or what it gave.
template <class Value>
struct UriResult {
  std::optional<Value> value;
  std::string reason;       ///< if there is no value
  bool leads_out = false;   ///< the reason is that the place is outside the folder
  bool is_missing = false;  ///< the reason is that there is no such file
};

/// "data:image/png;base64,iVBO...": whether bytes stand in the URI itself.
bool is_data_uri(std::string_view uri);

/// The bytes in a data URI, base64 or percent-encoded. Bytes that are no base64 digits are a reason.
UriResult<std::string> decode_data_uri(std::string_view uri);

/// The regular file below `folder` (empty: nowhere) that a relative URI, percent-encoded or not, names. Absolute paths,
/// addresses with a scheme ("http:", "C:"), ".." out of the folder and symbolic links out of it are reasons.
UriResult<std::filesystem::path> file_inside(const std::filesystem::path& folder, const std::string& uri);

/// The same, but paths out of the folder and absolute ones are taken if `allow_outside`; addresses never are.
UriResult<std::filesystem::path> find_file(const std::filesystem::path& folder, const std::string& uri,
                                           bool allow_outside);

}  // namespace facemap
