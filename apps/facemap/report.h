#pragma once

#include <chrono>
#include <string>

namespace facemap::program {

/// How much is said on standard error, and how. Set once, before anything is said.
struct ReportStyle {
  bool quiet = false;    ///< errors alone
  bool verbose = false;  ///< phases and times too
  bool json = false;     ///< objects, one a line, of these keys: event, message; phase, fraction, seconds, seconds_left
};
void set_report_style(const ReportStyle& style);
const ReportStyle& report_style();

/// "facemap: warning: text"; json: {"event": "warning", "message": text}.
void warn(const std::string& text);

/// "facemap: text"; event note.
void note(const std::string& text);

/// The same, for what only --verbose wants to know.
void note_verbose(const std::string& text);

/// "facemap: text"; event error. Is always said.
void say_error(const std::string& text);

/// Only as JSON: event done, with the seconds it took.
void say_done(double seconds);

/// Only as JSON: event progress.
void say_progress(const std::string& phase, double fraction, double seconds_left);

bool is_utf8(const std::string& text);

/// Text as a JSON string; bytes that are no UTF-8 become U+FFFD.
std::string json_text(const std::string& text);

}  // namespace facemap::program
