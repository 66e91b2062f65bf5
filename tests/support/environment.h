#pragma once

#include <cstdint>
#include <cstdlib>

/// The number that an environment variable holds, in C's notation; `otherwise` if it is not set.
inline std::uint64_t number_from_environment(const char* name, std::uint64_t otherwise) {
  const char* text = std::getenv(name);
  return text != nullptr ? std::strtoull(text, nullptr, 0) : otherwise;
}
