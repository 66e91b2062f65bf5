#pragma once

#include <facemap/error.h>

#include <array>
#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace facemap {

/// Parses JSON text. Throws LoadError with line and column: BadSyntax; TooLarge if values are nested more deeply than
/// any glTF needs.
nlohmann::json parse_json(std::string_view text, const std::string& name);

/// A value of a glTF file's JSON text that knows its place there, so that whatever is wrong with it is said with
/// that ("materials[3].pbrMetallicRoughness"). The parsed text and the file's name must outlive it.
class GltfValue {
 public:
  GltfValue(const nlohmann::json& root, const std::string& name) : json_(&root), name_(&name) {}

  const std::string& path() const noexcept { return path_; }

  /// Throws LoadError: "file: path: reason".
  [[noreturn]] void fail(LoadError::Cause cause, const std::string& reason) const;

  /// Members of an object; all throw if this is none, or a member is of the wrong type.
  std::optional<GltfValue> find(std::string_view key) const;
  GltfValue at(std::string_view key) const;  ///< throws if it is not there
  std::optional<GltfValue> extension(std::string_view name) const;
  double number(std::string_view key, double otherwise) const;  ///< finite
  bool flag(std::string_view key, bool otherwise) const;
  std::string text(std::string_view key, const std::string& otherwise) const;
  std::uint64_t integer(std::string_view key, std::uint64_t otherwise) const;
  std::optional<std::uint32_t> index(std::string_view key) const;
  std::vector<GltfValue> elements(std::string_view key) const;  ///< of an array; none if it is not there
  std::size_t count(std::string_view key) const;                ///< of those elements

  /// Element `index` of the array `key`; throws BadIndex, with the place that names it, if there are not so many.
  GltfValue element(std::string_view key, std::uint32_t index, const GltfValue& named_by) const;

  /// The numbers of an array of exactly so many.
  template <std::size_t kCount>
  std::array<double, kCount> numbers(std::string_view key, std::array<double, kCount> otherwise) const {
    const std::optional<GltfValue> array = find(key);
    if (array) array->read_numbers(otherwise.data(), kCount);
    return otherwise;
  }

  /// This value itself.
  double as_number() const;
  std::uint64_t as_integer() const;  ///< from 0
  std::uint32_t as_index() const;
  std::string as_text() const;

 private:
  GltfValue(const nlohmann::json& json, const std::string& name, std::string path)
      : json_(&json), name_(&name), path_(std::move(path)) {}

  const nlohmann::json* array_of(std::string_view key) const;  ///< null if it is not there
  void read_numbers(double* numbers, std::size_t count) const;
  GltfValue member(std::string_view key, const nlohmann::json& value) const;
  GltfValue member(std::string_view key, const nlohmann::json& value, std::size_t index) const;

  const nlohmann::json* json_;
  const std::string* name_;
  std::string path_;
};

}  // namespace facemap
