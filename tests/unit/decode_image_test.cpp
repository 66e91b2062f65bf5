#include "image/decode_image.h"

#include <facemap/error.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <set>

namespace facemap {
namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

TEST(DecodeImage, RefusesOtherFiles) {
  for (const Bytes& bytes : {Bytes{}, Bytes{0xff, 0xd8}, Bytes{'G', 'I', 'F', '8', '9', 'a'}}) {
    try {
      decode_image(bytes, "a.gif", 100);
      ADD_FAILURE() << "was read";
    } catch (const LoadError& error) {
      EXPECT_EQ(error.cause(), LoadError::Cause::UnknownFormat);
      EXPECT_STREQ(error.what(), "a.gif: it is neither PNG nor JPEG");
    }
  }
}

TEST(DecodeImage, ReadsThePicturesOfTheTestModels) {
  const char* const variable = std::getenv("FACEMAP_MODELS");
  const std::filesystem::path folder = variable != nullptr ? variable : FACEMAP_SOURCE_DIR "/../shared/models";
  if (!std::filesystem::exists(folder / "facts.jsonl")) {
    std::cout << "skipped: no test models in " << folder << '\n';
    return;
  }
  const std::set<std::string> kinds = {".png", ".jpg", ".jpeg"};
  int read = 0, with_alpha = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    if (!kinds.count(entry.path().extension().string())) continue;
    SCOPED_TRACE(entry.path());
    const DecodedImage image = decode_image(read_bytes(entry.path()), entry.path().string(), 1 << 28);
    EXPECT_EQ(image.rgba.size(), 4 * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    with_alpha += image.has_alpha;
    ++read;
  }
  std::cout << read << " pictures read, " << with_alpha << " with alpha\n";
  EXPECT_GT(read, 0);
}

}  // namespace
}  // namespace facemap
