#include "output.h"

#include <facemap/error.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <string>

#include "usage_error.h"

namespace facemap::program {

namespace fs = std::filesystem;

namespace {

/// Whether a file is a model's, by its name: no picture and no scene file is called so.
bool names_model_file(const fs::path& path) {
  constexpr std::array kExtensions = {".obj", ".mtl", ".gltf", ".glb", ".ply", ".stl"};
  std::string extension = path.extension().string();
  for (char& c : extension) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return std::find(kExtensions.begin(), kExtensions.end(), extension) != kExtensions.end();
}

}  // namespace

bool is_standard_output(const fs::path& output) { return output == "-"; }

fs::path settled_name(const fs::path& file) {
  std::error_code failed;
  const fs::path name = fs::weakly_canonical(fs::absolute(file), failed);
  return failed ? file.lexically_normal() : name;
}

void check_output(const fs::path& output, const fs::path& model) {
  if (output.empty()) throw UsageError("no output file is given: add -o FILE, or -o - for standard output");
  if (is_standard_output(output)) return;
  std::error_code ignored, error;
  const fs::file_status status = fs::status(output, error);
  if (error == std::errc::filename_too_long) throw Error(output.string() + ": cannot write: " + error.message());
  if (!model.empty() && fs::equivalent(output, model, ignored)) {
    throw UsageError(output.string() + ": the output would replace the model");
  }
  if (!model.empty() && fs::is_regular_file(status) && names_model_file(output))
    throw UsageError(output.string() + ": the output would replace a model's file");
  if (fs::is_directory(status)) throw Error(output.string() + ": cannot write: it is a folder");
  const bool is_special = fs::exists(status) && !fs::is_regular_file(status);
  fs::path folder = output.parent_path();
  if (folder.empty()) folder = ".";
  if (!fs::is_directory(folder, ignored)) {
    throw Error(output.string() + ": cannot write: there is no folder " + folder.string());
  }
  const int refused = ::access((is_special ? output : folder).c_str(), is_special ? W_OK : W_OK | X_OK);
  if (refused) throw Error(output.string() + ": cannot write: " + std::strerror(errno));
}

void check_picture_output(const fs::path& output, const fs::path& model) {
  if (is_standard_output(output) && ::isatty(STDOUT_FILENO)) {
    throw UsageError("-o -: standard output is a terminal; send it to a file or a program");
  }
  check_output(output, model);
}

void write_to_standard_output(std::span<const std::uint8_t> bytes) {
  while (!bytes.empty()) {
    const ::ssize_t written = ::write(STDOUT_FILENO, bytes.data(), bytes.size());
    if (written < 0) {
      if (errno == EINTR) continue;
      throw Error(std::string("standard output: cannot write: ") + std::strerror(errno));
    }
    bytes = bytes.subspan(static_cast<std::size_t>(written));
  }
}

}  // namespace facemap::program
