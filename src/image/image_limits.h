#pragma once

#include <cstdint>
#include <string>

namespace facemap {

/// Throws LoadError: BadImage if there are no pixels, TooLarge if there are more than `max_pixels`.
void check_picture_size(const std::string& name, std::uint64_t width, std::uint64_t height, std::uint64_t max_pixels);

/// Throws LoadError BadImage if a file of `file_bytes` cannot hold as much as its header promises: `units`, of which a
/// byte of the file holds at most `units_a_byte`. To be asked before memory for them is taken.
void check_promise(const std::string& name, std::uint64_t units, std::uint64_t file_bytes, std::uint64_t units_a_byte);

/// Throws LoadError BadImage: "name: what cannot be read: reason".
[[noreturn]] void refuse_picture(const std::string& name, const char* format, const std::string& reason);

}  // namespace facemap
