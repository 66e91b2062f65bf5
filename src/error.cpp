#include <facemap/error.h>

namespace facemap {

namespace {

std::string place(const std::string& file, std::int64_t line, std::int64_t column) {
  if (line <= 0) return file + ": ";
  return file + ":" + std::to_string(line) + (column > 0 ? ":" + std::to_string(column) : "") + ": ";
}

}  // namespace

LoadError::LoadError(Cause cause, const std::string& file, std::int64_t line, const std::string& reason,
                     std::int64_t column)
    : Error(place(file, line, column) + reason),
      cause_(cause),
      file_(file),
      line_(line),
      column_(column),
      reason_(reason) {}

}  // namespace facemap
