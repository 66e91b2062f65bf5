#include "scene/uri.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "support/gltf_text.h"

namespace facemap {
namespace {

TEST(Uri, DecodesBase64) {
  for (const std::string bytes : {"", "a", "ab", "abc", "\xff\xfe\x00\x01\x7f"}) {
    EXPECT_EQ(decode_data_uri("data:x/y;base64," + base64(bytes)).value, bytes);
  }
  EXPECT_EQ(decode_data_uri("data:;base64,YWI").value, "ab");  // without padding
  EXPECT_FALSE(decode_data_uri("data:;base64,Y W").value);
  EXPECT_FALSE(decode_data_uri("data:;base64").value);
  EXPECT_EQ(decode_data_uri("data:,a%20b%").value, "a b%");
}

TEST(Uri, NamesNoFileOutsideTheFolder) {
  for (const char* const uri : {"../x", "a/../../x", "/etc/passwd", "%2Fetc/passwd", "http://a/b", "C:\\x", "file:x"}) {
    const auto result = file_inside(".", uri);
    EXPECT_FALSE(result.value) << uri;
    EXPECT_TRUE(result.leads_out) << uri;
    EXPECT_FALSE(result.reason.empty());
  }
  for (const char* const uri : {"", "there/is/none", "a%00b", "."}) {
    const auto result = file_inside(".", uri);
    EXPECT_FALSE(result.value) << uri;
    EXPECT_FALSE(result.leads_out) << uri;
    EXPECT_FALSE(result.reason.empty());
  }
}

TEST(Uri, FilesOutsideAreTakenIfThatIsAllowed) {
  namespace fs = std::filesystem;
  const fs::path root = fs::temp_directory_path() / ("facemap-uri-" + std::to_string(::getpid()));
  fs::create_directories(root / "model");
  std::ofstream(root / "outside.png") << "x";
  const std::string absolute = (root / "outside.png").string();
  for (const std::string& uri : {std::string("../outside.png"), absolute}) {
    EXPECT_TRUE(find_file(root / "model", uri, false).leads_out) << uri;
    const auto found = find_file(root / "model", uri, true);
    ASSERT_TRUE(found.value) << uri << ": " << found.reason;
    EXPECT_EQ(*found.value, fs::canonical(absolute));
  }
  EXPECT_FALSE(find_file(root / "model", "http://example.com/outside.png", true).value);
  EXPECT_FALSE(find_file(root / "model", "../absent.png", true).value);
  fs::remove_all(root);
}

}  // namespace
}  // namespace facemap
