#include "scene/obj_lines.h"

namespace facemap {

ObjLines::ObjLines(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) at_ += kByteOrderMark.size();
}

void ObjLines::copy_line() {
  copy_.clear();
  lines_taken_ = 0;
  bool continued = true;
  while (continued && at_ != end_) {
    const auto* newline = static_cast<const char*>(std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_)));
    const char* line_end = newline == nullptr ? end_ : newline;
    continued = is_continued(line_end);
    if (line_end != at_ && line_end[-1] == '\r') --line_end;
    copy_.append(at_, line_end - continued);
    copy_.push_back(continued ? ' ' : '\n');
    ++lines_taken_;
    at_ = newline == nullptr ? end_ : newline + 1;

    if (lines_taken_ == 1 && *skip_blanks(copy_.c_str()) == '#') continued = false;
  }
  copy_.back() = '\n';
  copy_.append(kReadableBeyondEnd, '\n');
  begin_ = copy_.c_str();
}

std::string_view rest_of_line(const char* at) {
  at = skip_blanks(at);
  const char* end = at;
  while (*end != '\n') ++end;
  while (end != at && is_blank(end[-1])) --end;
  return {at, static_cast<std::size_t>(end - at)};
}

namespace {

/// Length of the UTF-8 sequence at the head of `text`, 1 to 4; 0 if it is none.
std::size_t utf8_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
  if (length > text.size()) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((static_cast<unsigned char>(text[i]) & 0xC0) != 0x80) return 0;
  }
  if (length < 3) return length;
  // Overlong forms, surrogates and what is past U+10FFFF show in the second byte.
  const auto second = static_cast<unsigned char>(text[1]);
  const bool bad = (lead == 0xE0 && second < 0xA0) || (lead == 0xED && second > 0x9F) ||
                   (lead == 0xF0 && second < 0x90) || (lead == 0xF4 && second > 0x8F);
  return bad ? 0 : length;
}

}  // namespace

std::string printable(std::string_view text) {
  constexpr std::size_t kMaxShown = 60;  // bytes
  std::string shown;
  while (!text.empty()) {
    if (shown.size() >= kMaxShown) return shown + "...";
    const std::size_t length = utf8_length(text);
    const auto lead = static_cast<unsigned char>(text[0]);
    const bool is_control = lead < 0x20 || lead == 0x7F || (lead == 0xC2 && text.substr(1, 1) < "\xA0");
    if (length == 0 || is_control) {
      shown.push_back('?');
      text.remove_prefix(1);
    } else {
      shown.append(text.substr(0, length));
      text.remove_prefix(length);
    }
  }
  return shown;
}

}  // namespace facemap
