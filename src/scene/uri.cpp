#include "scene/uri.h"

#include <algorithm>
#include <cstdint>
#include <system_error>
#include <utility>

namespace facemap {

namespace {

namespace fs = std::filesystem;

constexpr int kNoDigit = -1;

int hexadecimal_digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return kNoDigit;
}

int base64_digit(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : c == '/' ? 63 : kNoDigit;
}

/// A '%' without two digits stands for itself: names with one are common.
std::string decode_percent(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool has_digits = text[i] == '%' && i + 2 < text.size();
    const int high = has_digits ? hexadecimal_digit(text[i + 1]) : kNoDigit;
    const int low = has_digits ? hexadecimal_digit(text[i + 2]) : kNoDigit;
    if (high == kNoDigit || low == kNoDigit) {
      result += text[i];
    } else {
      result += static_cast<char>(high * 16 + low);
      i += 2;
    }
  }
  return result;
}

UriResult<std::string> decode_base64(std::string_view text) {
  while (text.ends_with('=')) text.remove_suffix(1);
  std::string result;
  result.reserve(text.size() / 4 * 3 + 3);
  std::uint32_t bits = 0;
  int count = 0;  // of bits that are not written
  for (const char c : text) {
    const int digit = base64_digit(c);
    if (digit == kNoDigit) return {std::nullopt, "a data URI whose bytes are not base64"};
    bits = bits << 6 | static_cast<std::uint32_t>(digit);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    result += static_cast<char>(bits >> count & 0xff);
  }
  return {std::move(result), ""};
}

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// Letters, digits, '+', '-', '.' before a colon; a single letter is a drive of other systems.
bool has_scheme(std::string_view uri) {
  const std::size_t colon = uri.find(':');
  if (colon == std::string_view::npos || colon == 0 || !is_letter(uri[0])) return false;
  return std::all_of(uri.begin(), uri.begin() + static_cast<std::ptrdiff_t>(colon),
                     [](char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '+' || c == '-' || c == '.'; });
}

bool is_below(const fs::path& path, const fs::path& folder) {
  return std::mismatch(folder.begin(), folder.end(), path.begin(), path.end()).first == folder.end();
}

/// Finds `name` with all symbolic links followed.
UriResult<fs::path> find_below(const fs::path& folder, const fs::path& name, bool allow_outside) {
  std::error_code error;
  const fs::path top = fs::canonical(folder, error);
  if (error) return {std::nullopt, "the model's folder is not there"};
  const fs::path path = fs::canonical(top / name, error);
  if (error) return {std::nullopt, "there is no such file", false, true};
  if (!allow_outside && !is_below(path, top)) return {std::nullopt, "is a link out of the model's folder", true};
  if (!fs::is_regular_file(path, error)) return {std::nullopt, "is not a file", false, true};
  return {path, ""};
}

}  // namespace

bool is_data_uri(std::string_view uri) { return uri.starts_with("data:"); }

UriResult<std::string> decode_data_uri(std::string_view uri) {
  const std::size_t comma = uri.find(',');
  if (!is_data_uri(uri) || comma == std::string_view::npos) return {std::nullopt, "a data URI without a comma"};
  const std::string_view bytes = uri.substr(comma + 1);
  if (uri.substr(0, comma).ends_with(";base64")) return decode_base64(bytes);
  return {decode_percent(bytes), ""};
}

UriResult<fs::path> file_inside(const fs::path& folder, const std::string& uri) {
  return find_file(folder, uri, false);
}

UriResult<fs::path> find_file(const fs::path& folder, const std::string& uri, bool allow_outside) {
  if (folder.empty()) return {std::nullopt, "is not looked for: the model has no folder"};
  if (has_scheme(uri)) return {std::nullopt, "is an address, not a file of the model's folder", true};
  const std::string decoded = decode_percent(uri);
  if (decoded.empty()) return {std::nullopt, "is empty", false, true};
  if (decoded.find('\0') != std::string::npos) return {std::nullopt, "has a NUL byte"};
  const fs::path name(decoded);
  if (has_scheme(decoded) || (name.is_absolute() && !allow_outside)) {
    return {std::nullopt, "is an absolute path", true};
  }
  const fs::path normal = name.lexically_normal();
  if (*normal.begin() == ".." && !allow_outside) return {std::nullopt, "leads out of the model's folder", true};
  return find_below(folder, normal, allow_outside);
}

}  // namespace facemap
