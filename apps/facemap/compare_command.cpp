#include <facemap/compare.h>

#include <charconv>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>

#include "commands.h"
#include "exit_codes.h"
#include "file_format.h"
#include "output.h"
#include "pending_files.h"
#include "text_values.h"
#include "usage_error.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

/// A number of pixels, or a share of all.
struct PixelLimit {
  double number = 0;
  bool is_percent = false;

  bool allows(std::uint64_t count, double pixels) const {
    return static_cast<double>(count) <= (is_percent ? number / 100 * pixels : number);
  }
};

struct CompareArguments {
  fs::path a, b, difference;
  std::optional<double> threshold, mean_threshold;
  std::optional<PixelLimit> max_different;
  bool quiet = false;
};

double parse_positive(const std::string& text) {
  const double number = parse_number(text);
  if (number < 0) throw UsageError("'" + text + "' is below 0");
  return number;
}

PixelLimit parse_pixel_limit(const std::string& text) {
  if (!text.ends_with('%')) return {static_cast<double>(parse_whole_number(text, 0, 0x7fffffff)), false};
  const double percent = parse_positive(text.substr(0, text.size() - 1));
  if (percent > 100) throw UsageError("'" + text + "' is above 100%");
  return {percent, true};
}

std::string figure(double value) {
  char text[32];
  const auto end = std::to_chars(text, text + sizeof text, value, std::chars_format::general, 6).ptr;
  return {text, end};
}

double pixels_of(const PictureChannels& picture) {
  return static_cast<double>(picture.width) * static_cast<double>(picture.height);
}

/// A limit on the mean alone leaves single pixels free.
bool is_within(const Comparison& comparison, const CompareArguments& arguments, double pixels) {
  if (arguments.mean_threshold && !(comparison.mean <= *arguments.mean_threshold)) return false;
  if (arguments.mean_threshold && !arguments.threshold && !arguments.max_different) return true;
  return arguments.max_different.value_or(PixelLimit{}).allows(comparison.beyond, pixels);
}

void row(const char* name, const std::string& value) {
  std::cout << "  " << std::left << std::setw(22) << name << value << '\n';
}

void print(const Comparison& comparison, const PictureChannels& a, bool within) {
  const bool is_levels = a.unit == PictureChannels::Unit::Levels;
  std::string largest = figure(comparison.largest);
  if (!comparison.largest_channel.empty()) {
    largest += ", channel " + comparison.largest_channel + " of pixel " + std::to_string(comparison.largest_x) + "," +
               std::to_string(comparison.largest_y);
  }
  const double share = 100 * static_cast<double>(comparison.different) / pixels_of(a);
  row("size", std::to_string(a.width) + "x" + std::to_string(a.height));
  row("unit", is_levels ? "levels, 0 to 255" : "values");
  row("largest difference", largest);
  row("mean difference", figure(comparison.mean));
  row("pixels that differ", std::to_string(comparison.different) + " (" + figure(share) + " %)");
  row("beyond the threshold", std::to_string(comparison.beyond));
  row("PSNR", figure(comparison.psnr) + " dB");
  row("verdict", comparison.different == 0 ? "equal" : within ? "equal within the thresholds" : "different");
  std::cout << std::flush;
}

void check_difference_file(const CompareArguments& arguments) {
  if (arguments.difference.empty()) return;
  if (is_standard_output(arguments.difference))
    throw UsageError("--difference: the figures go to standard output; name a file");
  for (const fs::path& picture : {arguments.a, arguments.b}) {
    std::error_code ignored;
    if (fs::equivalent(arguments.difference, picture, ignored))
      throw UsageError(arguments.difference.string() + ": the difference would replace a picture");
  }
  format_of(arguments.difference);
  check_picture_output(arguments.difference, {});
}

int compare(const CompareArguments& arguments) {
  if (arguments.a.empty() || arguments.b.empty()) throw UsageError("two pictures are to be given");
  check_difference_file(arguments);
  const PictureChannels a = read_picture(arguments.a), b = read_picture(arguments.b);
  const Comparison comparison = compare_pictures(a, b, arguments.threshold.value_or(0));
  const bool within = is_within(comparison, arguments, pixels_of(a));
  if (!arguments.difference.empty()) {
    const FileFormat format = format_of(arguments.difference);
    write_output(arguments.difference, encode_picture(difference_picture(a, b), format, {}, {}, 0));
  }
  if (!arguments.quiet) print(comparison, a, within);
  return within ? kDone : kFailed;
}

std::vector<Option> compare_options(CompareArguments& arguments) {
  const auto parse_path = [](const std::string& text) { return fs::path(text); };
  return {
      {"A", "", "", "a picture: PNG, JPEG, PFM or EXR", into(arguments.a, parse_path)},
      {"B", "", "", "the picture to compare it with", into(arguments.b, parse_path)},
      {"--threshold", "N", "0",
       "the largest difference that a pixel may have: levels of 0 to 255, or values where the files have these",
       into(arguments.threshold, parse_positive)},
      {"--max-different", "N|P%", "0", "how many pixels, or how many in a hundred, may differ by more than that",
       into(arguments.max_different, parse_pixel_limit)},
      {"--mean-threshold", "N", "",
       "the largest mean difference of all channels of all pixels; if it is the only limit, single pixels are free",
       into(arguments.mean_threshold, parse_positive)},
      {"--difference", "FILE", "", "writes a picture of the differences: black is none, the largest is brightest",
       into(arguments.difference, parse_path)},
      {"-q,--quiet", "", "", "no figures: the exit code alone",
       [&arguments](const std::string&) { arguments.quiet = true; }},
  };
}

}  // namespace

Command compare_command() {
  const auto arguments = std::make_shared<CompareArguments>();
  Command command;
  command.name = "compare";
  command.summary = "Say how two pictures differ";
  command.text =
      "PNG and JPEG are compared in levels of 0 to 255 (16 bits in steps of 1/257), PFM and EXR in the values\n"
      "that they hold, channel by channel. Two NaN or equal infinities do not differ. PSNR is below 255 levels, or\n"
      "a value of 1. Pictures of different sizes, units or channels are an error.\n"
      "Exit code: 0 equal within the thresholds, 1 different or a file is at fault, 2 the command line is.\n";
  command.options = compare_options(*arguments);
  command.examples = {
      {"facemap compare a.png b.png", "are they equal, and if not, where and by how much?"},
      {"facemap compare a.png b.png --threshold 2 --max-different 0.1% -q && echo alike",
       "one pixel in a thousand may be off by more than two levels"},
      {"facemap compare a.exr b.exr --difference difference.png", "a picture of the differences"},
  };
  command.run = [arguments] { return compare(*arguments); };
  return command;
}

}  // namespace facemap::program
