#include "scene/gltf_value.h"

#include <nlohmann/json.hpp>
#include <utility>

namespace facemap {

namespace {

using Cause = LoadError::Cause;

}  // namespace

void GltfValue::fail(Cause cause, const std::string& reason) const {
  throw LoadError(cause, *name_, 0, path_.empty() ? reason : path_ + ": " + reason);
}

GltfValue GltfValue::member(std::string_view key, const nlohmann::json& value) const {
  return {value, *name_, path_.empty() ? std::string(key) : path_ + "." + std::string(key)};
}

GltfValue GltfValue::member(std::string_view key, const nlohmann::json& value, std::size_t index) const {
  GltfValue element = member(key, value);
  element.path_ += "[" + std::to_string(index) + "]";
  return element;
}

std::optional<GltfValue> GltfValue::find(std::string_view key) const {
  if (!json_->is_object()) fail(Cause::BadValue, "is not an object");
  const auto found = json_->find(key);
  if (found == json_->end()) return std::nullopt;
  return member(key, *found);
}

GltfValue GltfValue::at(std::string_view key) const {
  std::optional<GltfValue> found = find(key);
  if (!found) fail(Cause::BadValue, "has no \"" + std::string(key) + "\"");
  return *std::move(found);
}

std::optional<GltfValue> GltfValue::extension(std::string_view name) const {
  const std::optional<GltfValue> extensions = find("extensions");
  return extensions ? extensions->find(name) : std::nullopt;
}

double GltfValue::number(std::string_view key, double otherwise) const {
  const std::optional<GltfValue> found = find(key);
  return found ? found->as_number() : otherwise;
}

bool GltfValue::flag(std::string_view key, bool otherwise) const {
  const std::optional<GltfValue> found = find(key);
  if (!found) return otherwise;
  if (!found->json_->is_boolean()) found->fail(Cause::BadValue, "is neither true nor false");
  return found->json_->get<bool>();
}

std::string GltfValue::text(std::string_view key, const std::string& otherwise) const {
  const std::optional<GltfValue> found = find(key);
  return found ? found->as_text() : otherwise;
}

std::uint64_t GltfValue::integer(std::string_view key, std::uint64_t otherwise) const {
  const std::optional<GltfValue> found = find(key);
  return found ? found->as_integer() : otherwise;
}

std::optional<std::uint32_t> GltfValue::index(std::string_view key) const {
  const std::optional<GltfValue> found = find(key);
  if (!found) return std::nullopt;
  return found->as_index();
}

const nlohmann::json* GltfValue::array_of(std::string_view key) const {
  const std::optional<GltfValue> found = find(key);
  if (!found) return nullptr;
  if (!found->json_->is_array()) found->fail(Cause::BadValue, "is not an array");
  return found->json_;
}

std::size_t GltfValue::count(std::string_view key) const {
  const nlohmann::json* const array = array_of(key);
  return array == nullptr ? 0 : array->size();
}

std::vector<GltfValue> GltfValue::elements(std::string_view key) const {
  std::vector<GltfValue> result;
  const nlohmann::json* const array = array_of(key);
  if (array == nullptr) return result;
  result.reserve(array->size());
  for (const nlohmann::json& json : *array) result.push_back(member(key, json, result.size()));
  return result;
}

GltfValue GltfValue::element(std::string_view key, std::uint32_t index, const GltfValue& named_by) const {
  const nlohmann::json* const array = array_of(key);
  const std::size_t size = array == nullptr ? 0 : array->size();
  if (index >= size) {
    named_by.fail(Cause::BadIndex,
                  "names " + std::string(key) + "[" + std::to_string(index) + "] of " + std::to_string(size));
  }
  return member(key, (*array)[index], index);
}

double GltfValue::as_number() const {
  // The parser refuses numbers beyond a double's range: what is here is finite.
  if (!json_->is_number()) fail(Cause::BadValue, "is not a number");
  return json_->get<double>();
}

std::uint64_t GltfValue::as_integer() const {
  if (json_->is_number_unsigned()) return json_->get<std::uint64_t>();
  // Some writers put 12.0 for 12.
  constexpr double kBeyond = 0x1p53;
  const double value = json_->is_number_float() ? json_->get<double>() : -1;
  if (!(value >= 0 && value < kBeyond && value == static_cast<double>(static_cast<std::uint64_t>(value)))) {
    fail(Cause::BadValue, "is not a whole number from 0");
  }
  return static_cast<std::uint64_t>(value);
}

std::uint32_t GltfValue::as_index() const {
  const std::uint64_t value = as_integer();
  if (value >= UINT32_MAX) fail(Cause::BadIndex, "is an index of " + std::to_string(value));
  return static_cast<std::uint32_t>(value);
}

std::string GltfValue::as_text() const {
  if (!json_->is_string()) fail(Cause::BadValue, "is not a text");
  return json_->get<std::string>();
}

void GltfValue::read_numbers(double* numbers, std::size_t count) const {
  if (!json_->is_array() || json_->size() != count) {
    fail(Cause::BadValue, "is not an array of " + std::to_string(count) + " numbers");
  }
  for (std::size_t i = 0; i < count; ++i) {
    const GltfValue number((*json_)[i], *name_, path_ + "[" + std::to_string(i) + "]");
    numbers[i] = number.as_number();
  }
}

}  // namespace facemap
