#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace facemap::program {

/// "-" stands for standard output.
bool is_standard_output(const std::filesystem::path& output);

/// The name that the file system has for a file, which need not be there.
std::filesystem::path settled_name(const std::filesystem::path& file);

/// Finds out before the work begins whether a file can be put there. Throws UsageError if it would replace
/// `model` (may be empty: then models may be replaced) or a file that is a model's by its name, Error if its folder is
/// absent or cannot be written to.
void check_output(const std::filesystem::path& output, const std::filesystem::path& model);

/// As above, and refuses a terminal as standard output.
void check_picture_output(const std::filesystem::path& output, const std::filesystem::path& model);

/// Throws Error if not all bytes can be written.
void write_to_standard_output(std::span<const std::uint8_t> bytes);

}  // namespace facemap::program
