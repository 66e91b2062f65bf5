#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "scene/number.h"

namespace facemap {

/// Cuts OBJ or MTL text into logical lines. A backslash at the end of a line joins the next one to it, with a
/// blank between them; a comment's does not.
class ObjLines {
 public:
  /// `text` must stay where it is. A byte order mark at its head is skipped.
  explicit ObjLines(std::string_view text);

  /// Goes to the next line; false at the end of the text.
  bool next() {
    if (at_ == end_) return false;
    number_ += lines_taken_;
    lines_taken_ = 1;
    const auto* newline = static_cast<const char*>(std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)));
    if (newline == nullptr || end_ - newline <= kReadableBeyondEnd || is_continued(newline)) {
      copy_line();
    } else {
      begin_ = at_;
      at_ = newline + 1;
    }
    return true;
  }

  /// The line, which ends in '\n' with kReadableBeyondEnd bytes behind it. Valid until next().
  const char* begin() const { return begin_; }

  /// Where the line stands in the file, from 1; for a joined line, its first.
  std::int64_t number() const { return number_; }

 private:
  /// Whether the line from at_ to `newline` ends in a backslash.
  bool is_continued(const char* newline) const {
    if (newline != at_ && newline[-1] == '\r') --newline;
    return newline != at_ && newline[-1] == '\\';
  }

  /// Takes lines that cannot be used in place: continued ones, and those too near to the end of the text.
  void copy_line();

  const char* at_;
  const char* end_;
  const char* begin_ = nullptr;
  std::int64_t number_ = 0;
  std::int64_t lines_taken_ = 1;
  std::string copy_;
};

/// The words of a name that ends a line, without blanks at either end.
std::string_view rest_of_line(const char* at);

/// Text of a file as it may stand in a message: control bytes and bytes that are not UTF-8 become '?', and a
/// long one is cut.
std::string printable(std::string_view text);

}  // namespace facemap
