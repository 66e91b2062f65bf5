#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "scene/number.h"

namespace facemap {

/// Cuts text into lines that the scanners of number.h can read.
class TextLines {
 public:
  /// `text` must stay where it is; its first line is number `first_line` of the file.
  explicit TextLines(std::string_view text, std::int64_t first_line = 1)
      : at_(text.data()), end_(text.data() + text.size()), number_(first_line - 1) {}

  /// Goes to the next line; false at the end of the text.
  bool next() {
    if (at_ == end_) return false;
    ++number_;
    const auto* newline = static_cast<const char*>(std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)));
    if (newline == nullptr || end_ - newline <= kReadableBeyondEnd) {
      copy_line(newline == nullptr ? end_ : newline);
    } else {
      begin_ = at_;
    }
    at_ = newline == nullptr ? end_ : newline + 1;
    return true;
  }

  /// The line, which ends in '\n' with kReadableBeyondEnd bytes behind it. Valid until next().
  const char* begin() const { return begin_; }

  /// Where the line stands in the file, from 1.
  std::int64_t number() const { return number_; }

  /// Bytes behind the line.
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }

 private:
  void copy_line(const char* line_end) {
    copy_.assign(at_, line_end);
    copy_.append(1 + kReadableBeyondEnd, '\n');
    begin_ = copy_.data();
  }

  const char* at_;
  const char* end_;
  const char* begin_ = "\n";
  std::int64_t number_;
  std::string copy_;
};

}  // namespace facemap
