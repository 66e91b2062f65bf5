#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>

#include "scene/gltf_buffers.h"

namespace facemap {

/// The numbers of a glTF accessor, read where they lie: of any component type, normalised or not, with elements that
/// a sparse list replaces. An accessor without bytes has zeros. The buffers must outlive it.
class GltfAccessor {
 public:
  /// glTF's numbers of the types.
  enum class Type { Int8 = 5120, Uint8 = 5121, Int16 = 5122, Uint16 = 5123, Uint32 = 5125, Float32 = 5126 };

  /// Throws LoadError if it is not as the format has it, or its bytes are not all there.
  GltfAccessor(const GltfFile& file, GltfBuffers& buffers, std::uint32_t index, const GltfValue& named_by);

  const std::string& path() const noexcept { return value_.path(); }
  [[noreturn]] void fail(LoadError::Cause cause, const std::string& reason) const { value_.fail(cause, reason); }

  std::uint32_t count() const noexcept { return count_; }
  int components() const noexcept { return components_; }  ///< of an element: 1 to 4, or 16 (columns of a matrix)
  Type type() const noexcept { return numbers_.type; }
  bool is_normalised() const noexcept { return numbers_.is_normalised; }
  bool is_unsigned_integer() const noexcept;

  /// Component `component` of element `element`, both within the bounds; may be infinite or NaN.
  double number(std::uint32_t element, int component) const;

 private:
  struct Numbers {
    std::string_view bytes;
    std::uint64_t stride = 0;
    Type type = Type::Float32;
    bool is_normalised = false;

    double at(std::uint64_t element, int component) const;
  };

  Numbers open_numbers(const GltfFile& file, GltfBuffers& buffers, const GltfValue& place, std::uint64_t count) const;
  void open_sparse(const GltfFile& file, GltfBuffers& buffers, const GltfValue& sparse);

  GltfValue value_;
  std::uint32_t count_ = 0;
  int components_ = 0;
  Numbers numbers_;
  std::uint32_t sparse_count_ = 0;
  Numbers sparse_indices_, sparse_numbers_;
};

/// The accessors of a file, each checked once.
class GltfAccessors {
 public:
  GltfAccessors(const GltfFile& file, GltfBuffers& buffers) : file_(file), buffers_(buffers) {}

  /// accessors[index]; `named_by` is whose index it is. Valid as long as this object. Throws LoadError.
  const GltfAccessor& open(std::uint32_t index, const GltfValue& named_by);

 private:
  const GltfFile& file_;
  GltfBuffers& buffers_;
  std::unordered_map<std::uint32_t, GltfAccessor> accessors_;
};

}  // namespace facemap
