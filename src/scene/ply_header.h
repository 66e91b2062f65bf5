#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "scene/obj_warnings.h"

namespace facemap {

enum class PlyType : std::uint8_t { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };

std::size_t size_of(PlyType type);
bool is_whole(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;  ///< of the value, or of a list's values
  bool is_list = false;
  PlyType count_type = PlyType::UInt8;  ///< of a list
};

/// "No property has this name."
inline constexpr std::size_t kNoProperty = static_cast<std::size_t>(-1);

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// The number of the first property of that name, or kNoProperty.
  std::size_t find(std::string_view property) const;

  bool has_lists() const;

  /// Bytes of a row in a binary file; of one with lists, the least there may be.
  std::size_t least_row_size() const;
};

enum class PlyFormat { Text, LittleEndian, BigEndian };

/// What the head of a PLY file says: which elements follow, in which order, with which properties.
struct PlyHeader {
  PlyFormat format = PlyFormat::Text;
  std::vector<PlyElement> elements;
  std::vector<std::string> texture_files;  ///< of "comment TextureFile NAME", as written
  std::size_t size = 0;                    ///< bytes up to the body
  std::int64_t lines = 0;                  ///< the same in lines

  /// The first element of that name, or nullptr.
  const PlyElement* find(std::string_view element) const;
};

/// Reads the head of `bytes`. Throws LoadError, with the line.
PlyHeader read_ply_header(std::string_view bytes, const std::string& name, ObjWarnings& warnings);

}  // namespace facemap
