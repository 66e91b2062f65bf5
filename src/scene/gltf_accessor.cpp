#include "scene/gltf_accessor.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "scene/obj_lines.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;
using Type = GltfAccessor::Type;

static_assert(std::endian::native == std::endian::little);

int component_count(const GltfValue& accessor) {
  struct Known {
    std::string_view name;
    int components;
  };
  constexpr Known kKnown[] = {{"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
  const GltfValue type = accessor.at("type");
  const std::string name = type.as_text();
  for (const Known& known : kKnown) {
    if (known.name == name) return known.components;
  }
  type.fail(Cause::BadValue, "\"" + printable(name) + "\" is not a type that anything here uses");
}

Type component_type(const GltfValue& holder) {
  const GltfValue value = holder.at("componentType");
  const std::uint32_t type = value.as_index();
  if (type < 5120 || type > 5126 || type == 5124) value.fail(Cause::BadValue, "is not a component type");
  return static_cast<Type>(type);
}

std::uint64_t size_of(Type type) {
  switch (type) {
    case Type::Int8:
    case Type::Uint8:
      return 1;
    case Type::Int16:
    case Type::Uint16:
      return 2;
    case Type::Uint32:
    case Type::Float32:
      break;
  }
  return 4;
}

template <class Stored>
double load(const char* at) {
  Stored stored;
  std::memcpy(&stored, at, sizeof stored);
  return static_cast<double>(stored);
}

/// Of the most negative integer, too, -1 is what it stands for.
double normalised(double value, double largest) { return std::max(value / largest, -1.0); }

}  // namespace

GltfAccessor::GltfAccessor(const GltfFile& file, GltfBuffers& buffers, std::uint32_t index, const GltfValue& named_by)
    : value_(file.root.element("accessors", index, named_by)) {
  components_ = component_count(value_);
  numbers_.type = component_type(value_);
  numbers_.is_normalised = value_.flag("normalized", false);
  value_.at("count");
  const std::uint64_t count = value_.integer("count", 0);
  if (count >= UINT32_MAX) fail(Cause::TooLarge, std::to_string(count) + " elements");
  count_ = static_cast<std::uint32_t>(count);
  const std::optional<GltfValue> sparse = value_.find("sparse");
  if (value_.find("bufferView")) {
    numbers_ = open_numbers(file, buffers, value_, count);
  } else if (count > buffers.total_bytes()) {
    // Zeros take no room in a file; so many of them are not meant well.
    fail(Cause::TooLarge, std::to_string(count) + " elements without bytes, more than the whole file has bytes");
  }
  if (sparse) open_sparse(file, buffers, *sparse);
}

GltfAccessor::Numbers GltfAccessor::open_numbers(const GltfFile& file, GltfBuffers& buffers, const GltfValue& place,
                                                 std::uint64_t count) const {
  const GltfValue view_index = place.at("bufferView");
  const GltfBytes view = buffers.view(view_index.as_index(), view_index);
  Numbers numbers = numbers_;
  const std::uint64_t component_size = size_of(numbers.type);
  const std::uint64_t size = component_size * static_cast<std::uint64_t>(components_);
  const std::uint64_t offset = place.integer("byteOffset", 0);
  numbers.stride = view.stride == 0 ? size : view.stride;
  if (numbers.stride < size) {
    place.fail(Cause::BadValue, "elements of " + std::to_string(size) + " bytes, " + std::to_string(view.stride) +
                                    " bytes from one to the next");
  }
  const std::uint64_t there = offset > view.bytes.size() ? 0 : view.bytes.size() - offset;
  const std::uint64_t whole = there < size ? 0 : (there - size) / numbers.stride + 1;
  if (count > whole) {
    place.fail(Cause::TruncatedStatement,
               std::to_string(count) + " elements, of which " + std::to_string(whole) + " are there");
  }
  if (offset % component_size != 0 || numbers.stride % component_size != 0) {
    file.warn(place, "numbers that are not aligned");
  }
  if (whole > 0) numbers.bytes = view.bytes.substr(offset);
  return numbers;
}

void GltfAccessor::open_sparse(const GltfFile& file, GltfBuffers& buffers, const GltfValue& sparse) {
  sparse.at("count");
  const std::uint64_t count = sparse.integer("count", 0);
  if (count > count_) sparse.fail(Cause::BadValue, std::to_string(count) + " elements of " + std::to_string(count_));
  sparse_count_ = static_cast<std::uint32_t>(count);
  sparse_numbers_ = open_numbers(file, buffers, sparse.at("values"), count);

  const GltfValue indices = sparse.at("indices");
  GltfAccessor scalars = *this;
  scalars.components_ = 1;
  scalars.numbers_.type = component_type(indices);
  scalars.numbers_.is_normalised = false;
  if (!scalars.is_unsigned_integer()) indices.fail(Cause::BadValue, "are not unsigned integers");
  sparse_indices_ = scalars.open_numbers(file, buffers, indices, count);
  double last = -1;
  for (std::uint32_t i = 0; i < sparse_count_; ++i) {
    const double index = sparse_indices_.at(i, 0);
    if (index <= last || index >= count_) indices.fail(Cause::BadIndex, "do not ascend, or go beyond the elements");
    last = index;
  }
}

bool GltfAccessor::is_unsigned_integer() const noexcept {
  return type() == Type::Uint8 || type() == Type::Uint16 || type() == Type::Uint32;
}

double GltfAccessor::Numbers::at(std::uint64_t element, int component) const {
  const char* const at = bytes.data() + element * stride + static_cast<std::uint64_t>(component) * size_of(type);
  switch (type) {
    case Type::Int8:
      return is_normalised ? normalised(load<std::int8_t>(at), 127) : load<std::int8_t>(at);
    case Type::Uint8:
      return is_normalised ? normalised(load<std::uint8_t>(at), 255) : load<std::uint8_t>(at);
    case Type::Int16:
      return is_normalised ? normalised(load<std::int16_t>(at), 32767) : load<std::int16_t>(at);
    case Type::Uint16:
      return is_normalised ? normalised(load<std::uint16_t>(at), 65535) : load<std::uint16_t>(at);
    case Type::Uint32:
      return is_normalised ? normalised(load<std::uint32_t>(at), UINT32_MAX) : load<std::uint32_t>(at);
    case Type::Float32:
      break;
  }
  return load<float>(at);
}

double GltfAccessor::number(std::uint32_t element, int component) const {
  std::uint32_t first = 0, last = sparse_count_;  // the first sparse index that is not below `element`
  while (first < last) {
    const std::uint32_t middle = first + (last - first) / 2;
    if (sparse_indices_.at(middle, 0) < element) {
      first = middle + 1;
    } else {
      last = middle;
    }
  }
  if (first < sparse_count_ && sparse_indices_.at(first, 0) == element) return sparse_numbers_.at(first, component);
  return numbers_.bytes.empty() ? 0 : numbers_.at(element, component);
}

const GltfAccessor& GltfAccessors::open(std::uint32_t index, const GltfValue& named_by) {
  const auto known = accessors_.find(index);
  if (known != accessors_.end()) return known->second;
  return accessors_.try_emplace(index, file_, buffers_, index, named_by).first->second;
}

}  // namespace facemap
