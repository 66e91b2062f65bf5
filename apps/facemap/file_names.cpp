#include "file_names.h"

#include <algorithm>

#include "output.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostDigits = 9;

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

/// A name with its placeholders, for one picture after the other.
class Pattern {
 public:
  Pattern(const fs::path& pattern, const fs::path& model, std::size_t all)
      : text_(pattern.string()),
        model_(model == "-" ? "model" : model.stem().string()),
        width_(std::to_string(all).size()) {}

  fs::path name(std::size_t number) const {
    std::string name;
    for (std::size_t at = 0; at < text_.size();) {
      const std::size_t end = text_[at] == '{' ? text_.find('}', at) : std::string::npos;
      const bool is_placeholder = end != std::string::npos && is_letter(text_[at + 1]);
      name += is_placeholder ? value(text_.substr(at + 1, end - at - 1), number) : std::string(1, text_[at]);
      at = is_placeholder ? end + 1 : at + 1;
    }
    return name;
  }

 private:
  std::string value(const std::string& placeholder, std::size_t number) const {
    if (placeholder == "model") return model_;
    if (placeholder == "n") return digits(number, width_);
    if (placeholder.size() == 4 && placeholder.starts_with("n:0") && is_digit(placeholder[3])) {
      return digits(number, static_cast<std::size_t>(placeholder[3] - '0'));
    }
    throw UsageError(text_ + ": {" + placeholder + "} stands for nothing; {n}, {n:04} and {model} do");
  }

  static std::string digits(std::size_t number, std::size_t width) {
    const std::string text = std::to_string(number);
    return std::string(width - std::min(width, text.size()), '0') + text;
  }

  std::string text_, model_;
  std::size_t width_;
};

void check_several(const fs::path& pattern, std::size_t count, const std::vector<fs::path>& files) {
  if (is_standard_output(pattern)) {
    throw UsageError("-o -: standard output takes one picture, not " + std::to_string(count));
  }
  if (files[0] != files[1]) return;
  const std::string proposal = pattern.stem().string() + "_{n}" + pattern.extension().string();
  throw UsageError(pattern.string() + ": the names of " + std::to_string(count) +
                   " pictures need {n}, the picture's number, such as " + proposal);
}

std::size_t number_in(const std::string& digits, const std::string& text) {
  if (digits.empty() || digits.size() > kMostDigits || !std::all_of(digits.begin(), digits.end(), is_digit)) {
    throw UsageError("'" + text + "' is not a picture's number or a range such as 0-9 or 0..9");
  }
  const std::size_t number = std::stoul(digits);
  if (number < static_cast<std::size_t>(kMaxFrames)) return number;
  throw UsageError("'" + text + "' goes beyond the " + std::to_string(kMaxFrames) + " pictures that a run can have");
}

}  // namespace

FrameRange parse_frame_range(const std::string& text) {
  const std::size_t end = static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_digit) - text.begin());
  const std::size_t first = number_in(text.substr(0, end), text);
  if (end == text.size()) return {first, first};
  const std::size_t separator = text.compare(end, 2, "..") == 0 ? 2 : text[end] == '-' ? 1 : 0;
  if (separator == 0) number_in("", text);
  const std::size_t last = number_in(text.substr(end + separator), text);
  if (last < first) throw UsageError("'" + text + "' ends before it begins");
  return {first, last};
}

std::vector<fs::path> frame_files(const fs::path& pattern, const fs::path& model, std::size_t all,
                                  const FrameRange& range) {
  const Pattern names(pattern, model, all);
  std::vector<fs::path> files;
  for (std::size_t number = range.first; number <= range.last; ++number) files.push_back(names.name(number));
  if (files.size() > 1) check_several(pattern, files.size(), files);
  return files;
}

}  // namespace facemap::program
