#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace facemap {

/// What is odd about a file without making it unreadable. Of each cause the first place is kept and all are
/// counted, so that a hostile file cannot fill the memory with complaints.
class ObjWarnings {
 public:
  explicit ObjWarnings(std::string file) : file_(std::move(file)) {}

  /// `line` counts from 1; 0: no line is to blame. `cause` must outlive this object (a literal); `detail` is text from
  /// the file and is made printable.
  void add(std::int64_t line, const char* cause, std::string_view detail = {});

  /// Appends "file:line: cause: detail (n times)", or "file: cause: ...", for each cause to `texts`.
  void append_to(std::vector<std::string>& texts) const;

 private:
  struct Warning {
    std::string_view cause;
    std::int64_t line;
    std::string detail;
    std::int64_t count;
  };
  std::string file_;
  std::vector<Warning> warnings_;
};

}  // namespace facemap
