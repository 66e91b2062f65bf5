#include "scene/obj_warnings.h"

#include "scene/obj_lines.h"

namespace facemap {

void ObjWarnings::add(std::int64_t line, const char* cause, std::string_view detail) {
  for (Warning& warning : warnings_) {
    if (warning.cause == cause) {
      ++warning.count;
      return;
    }
  }
  warnings_.push_back({cause, line, printable(detail), 1});
}

void ObjWarnings::append_to(std::vector<std::string>& texts) const {
  for (const Warning& warning : warnings_) {
    std::string text = file_;
    if (warning.line > 0) text += ":" + std::to_string(warning.line);
    text += ": " + std::string(warning.cause);
    if (!warning.detail.empty()) text += ": " + warning.detail;
    if (warning.count > 1) text += " (" + std::to_string(warning.count) + " times)";
    texts.push_back(std::move(text));
  }
}

}  // namespace facemap
