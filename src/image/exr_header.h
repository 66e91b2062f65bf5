#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace facemap {

/// The file with every attribute of its header that pixels do not depend on made opaque: OpenEXR would take memory for
/// what some of them say of themselves. All else stays at its place. Throws LoadError if the header is broken, or the
/// file has several parts or deep pixels.
std::vector<std::uint8_t> with_plain_header(std::span<const std::uint8_t> bytes, const std::string& name);

}  // namespace facemap
