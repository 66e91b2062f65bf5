#include <facemap/error.h>

namespace facemap {

LoadError::LoadError(Cause cause, const std::string& file, std::int64_t line, const std::string& reason)
    : Error(line > 0 ? file + ":" + std::to_string(line) + ": " + reason : file + ": " + reason),
      cause_(cause),
      file_(file),
      line_(line),
      reason_(reason) {}

}  // namespace facemap
