#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace facemap {

inline constexpr std::size_t kStlHeaderSize = 84;  ///< bytes: 80 of any content, and the count of facets
inline constexpr std::size_t kStlFacetSize = 50;   ///< bytes: normal, three vertices, two bytes of attributes

/// The count that a binary STL file of at least kStlHeaderSize bytes states.
std::uint32_t stl_facet_count(std::string_view bytes);

}  // namespace facemap
