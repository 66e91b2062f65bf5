#pragma once

#include <facemap/model.h>

#include <string>
#include <string_view>

namespace facemap {

/// Reads an STL file, text or binary; `name` stands in messages for it. Vertices of the same value become one, so that
/// the mesh is connected. The winding says which side of a facet is outside; its normal is read over, but for a warning
/// where most say the opposite. Throws LoadError.
Model read_stl(std::string_view bytes, const std::string& name, const ModelLimits& limits);

/// Whether bytes that are an STL file are a text: those that begin with "solid", but for a NUL byte at the head, and do
/// not have exactly the size that a binary file of their count of facets has.
bool is_stl_text(std::string_view bytes);

/// Whether the size of `bytes` is exactly that of a binary STL file with the count of facets that it states.
bool is_stl_binary_by_size(std::string_view bytes);

}  // namespace facemap
