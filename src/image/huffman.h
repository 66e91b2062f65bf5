#pragma once

#include <cstdint>
#include <span>

namespace facemap {

/// Lengths of a prefix code of the fewest bits for symbols that occur so often, `most` at most (2^most >= symbols;
/// close to the fewest where that limit is met). Symbols that do not occur get 0; one alone gets 1.
void find_code_lengths(std::span<const std::uint32_t> counts, unsigned most, std::span<std::uint8_t> lengths);

}  // namespace facemap
