#include "report.h"

#include <cstdint>
#include <cstdio>
#include <iostream>

namespace facemap::program {
namespace {

ReportStyle the_style;

/// Bytes of the UTF-8 character at `i`; 0 if there is none.
std::size_t character_length(const std::string& text, std::size_t i) {
  const auto byte = [&](std::size_t k) { return k < text.size() ? static_cast<unsigned char>(text[k]) : 0u; };
  const unsigned first = byte(i);
  const std::size_t length = first < 0x80                    ? 1
                             : first >= 0xc2 && first < 0xe0 ? 2
                             : first >= 0xe0 && first < 0xf0 ? 3
                             : first >= 0xf0 && first < 0xf5 ? 4
                                                             : 0;
  for (std::size_t k = 1; k < length; ++k) {
    if ((byte(i + k) & 0xc0u) != 0x80u) return 0;
  }
  const unsigned second = byte(i + 1);
  const bool is_overlong = (first == 0xe0 && second < 0xa0) || (first == 0xf0 && second < 0x90);
  const bool is_beyond = (first == 0xed && second >= 0xa0) || (first == 0xf4 && second >= 0x90);
  return is_overlong || is_beyond ? 0 : length;
}

std::string fixed(double value, int digits) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, "%.*f", digits, value);
  return buffer;
}

void say(const char* event, const char* before, const std::string& text) {
  if (the_style.json) {
    std::cerr << "{\"event\": \"" << event << "\", \"message\": " << json_text(text) << "}" << std::endl;
  } else {
    std::cerr << "facemap: " << before << text << std::endl;
  }
}

}  // namespace

void set_report_style(const ReportStyle& style) { the_style = style; }
const ReportStyle& report_style() { return the_style; }

void warn(const std::string& text) {
  if (!the_style.quiet) say("warning", "warning: ", text);
}

void note(const std::string& text) {
  if (!the_style.quiet) say("note", "", text);
}

void note_verbose(const std::string& text) {
  if (the_style.verbose) say("note", "", text);
}

void say_error(const std::string& text) { say("error", "", text); }

void say_done(double seconds) {
  if (the_style.json && !the_style.quiet) {
    std::cerr << "{\"event\": \"done\", \"seconds\": " << fixed(seconds, 3) << "}" << std::endl;
  }
}

void say_progress(const std::string& phase, double fraction, double seconds_left) {
  std::string line =
      "{\"event\": \"progress\", \"phase\": " + json_text(phase) + ", \"fraction\": " + fixed(fraction, 3);
  if (seconds_left >= 0) line += ", \"seconds_left\": " + fixed(seconds_left, 1);
  std::cerr << line + "}" << std::endl;
}

bool is_utf8(const std::string& text) {
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = character_length(text, i);
    if (length == 0) return false;
    i += length;
  }
  return true;
}

std::string json_text(const std::string& text) {
  std::string result = "\"";
  for (std::size_t i = 0; i < text.size();) {
    const auto code = static_cast<unsigned char>(text[i]);
    const std::size_t length = character_length(text, i);
    if (length == 0) {
      result += "\\ufffd";
    } else if (code == '"' || code == '\\') {
      result += {'\\', text[i]};
    } else if (code < 0x20) {
      char escaped[8];
      std::snprintf(escaped, sizeof escaped, "\\u%04x", code);
      result += escaped;
    } else {
      result.append(text, i, length);
    }
    i += length == 0 ? 1 : length;
  }
  return result + "\"";
}

}  // namespace facemap::program
