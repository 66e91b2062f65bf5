#include "default_output.h"

#include <facemap/error.h>

#include <fstream>
#include <string>

#include "input.h"

namespace facemap::program {
namespace {

namespace fs = std::filesystem;

/// Whether a PNG file says at its beginning that this program wrote it.
bool is_own_picture(const fs::path& path) {
  constexpr std::size_t kHead = 128;
  std::ifstream file(path, std::ios::binary);
  std::string head(kHead, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return head.starts_with("\x89PNG") && head.find(std::string("Software\0FaceMap", 16)) != std::string::npos;
}

}  // namespace

std::string default_output(const fs::path& model) {
  const fs::path picture = (is_standard_input(model) ? std::string("model") : model.stem().string()) + ".png";
  std::error_code ignored;
  const bool is_file = fs::is_regular_file(picture, ignored);  // reading what is none could last for ever
  if (fs::exists(picture, ignored) && !(is_file && is_own_picture(picture))) {
    throw Error(picture.string() + ": there is such a file that facemap did not write; name the picture with -o");
  }
  return "{model}.png";  // as it is: braces in a model's name stand for themselves
}

}  // namespace facemap::program
