#include <facemap/error.h>
#include <facemap/image.h>
#include <gtest/gtest.h>
#include <png.h>
#include <unistd.h>

#include <fstream>
#include <iterator>

namespace {

namespace fs = std::filesystem;
using facemap::Error;
using facemap::Image;

/// A folder of its own for each test, removed afterwards.
class Png : public testing::Test {
 protected:
  Png() {
    std::string name = (fs::temp_directory_path() / "facemap-png-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~Png() override { fs::remove_all(folder_); }

  std::size_t files_in_folder() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
};

Image make_image(int width, int height) {
  Image image;
  image.width = width;
  image.height = height;
  for (int i = 0; i < width * height; ++i) {
    const float t = static_cast<float>(i) / static_cast<float>(width * height);
    image.pixels.push_back({t, 1 - t, t * t * 1.5f});
  }
  return image;
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string error_of_write(const Image& image, const fs::path& path) {
  try {
    write_png(image, path);
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

TEST_F(Png, ReadsBackWhatItWrote) {
  for (const auto& [width, height] : {std::pair(1, 1), std::pair(3, 7), std::pair(257, 64)}) {
    const Image image = make_image(width, height);
    write_png(image, folder_ / "a.png");
    const facemap::Picture24 picture = facemap::read_png(folder_ / "a.png");
    ASSERT_EQ(picture.width, width);
    ASSERT_EQ(picture.height, height);
    ASSERT_EQ(picture.pixels.size(), image.pixels.size());
    for (std::size_t i = 0; i < image.pixels.size(); ++i) EXPECT_EQ(picture.pixels[i], image.pixels[i].to_24_bit());
  }
  EXPECT_EQ(files_in_folder(), 1u) << "a temporary file was left";
}

TEST_F(Png, BytesDoNotDependOnThreads) {
  const Image image = make_image(700, 900);
  const std::vector<std::uint8_t> bytes = encode_png(image, 1);
  for (const int threads : {0, 2, 3, 8}) EXPECT_TRUE(encode_png(image, threads) == bytes) << threads;
  write_png(image, folder_ / "a.png", 3);
  const facemap::Picture24 picture = facemap::read_png(folder_ / "a.png");
  ASSERT_EQ(picture.pixels.size(), image.pixels.size());
  for (std::size_t i = 0; i < image.pixels.size(); ++i) ASSERT_EQ(picture.pixels[i], image.pixels[i].to_24_bit()) << i;
}

TEST_F(Png, EncodesTheSameBytesAsItWrites) {
  const Image image = make_image(40, 30);
  write_png(image, folder_ / "a.png");
  const std::vector<std::uint8_t> bytes = encode_png(image);
  EXPECT_EQ(text_of(folder_ / "a.png"), std::string(bytes.begin(), bytes.end()));
}

TEST_F(Png, ReplacesAFileAndKeepsItsPermissions) {
  std::ofstream(folder_ / "a.png") << "old";
  fs::permissions(folder_ / "a.png", fs::perms(0640));
  write_png(make_image(2, 2), folder_ / "a.png");
  EXPECT_EQ(facemap::read_png(folder_ / "a.png").width, 2);
  EXPECT_EQ(fs::status(folder_ / "a.png").permissions(), fs::perms(0640));
}

TEST_F(Png, WritesThroughASymbolicLink) {
  fs::create_directory(folder_ / "real");
  std::ofstream(folder_ / "real/a.png") << "old";
  fs::create_symlink("real/a.png", folder_ / "link.png");
  write_png(make_image(2, 2), folder_ / "link.png");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link.png"));
  EXPECT_EQ(facemap::read_png(folder_ / "real/a.png").width, 2);
}

TEST_F(Png, WritesToADeviceWithoutReplacingIt) {
  write_png(make_image(2, 2), "/dev/null");
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_EQ(error_of_write(make_image(2, 2), "/dev/full"), "/dev/full: cannot write: No space left on device");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(Png, NamesTheFileAndTheReason) {
  const Image image = make_image(2, 2);
  const std::string folder = folder_.string();
  EXPECT_EQ(error_of_write(image, folder_), folder + ": cannot write: Is a directory");
  EXPECT_EQ(error_of_write(image, folder_ / "absent/a.png"),
            folder + "/absent/a.png: cannot write in its folder: No such file or directory");
  EXPECT_EQ(error_of_write(Image(), folder_ / "a.png"), "PNG: the image has no pixels");
  EXPECT_EQ(files_in_folder(), 0u);
}

TEST_F(Png, AFailedWriteLeavesTheOldFile) {
  std::ofstream(folder_ / "a.png") << "old";
  Image image = make_image(2, 2);
  image.pixels.pop_back();
  EXPECT_THROW(write_png(image, folder_ / "a.png"), Error);
  EXPECT_EQ(text_of(folder_ / "a.png"), "old");
}

TEST_F(Png, RefusesWhatIsNotARgbPicture) {
  EXPECT_THROW(facemap::read_png(folder_ / "absent.png"), Error);
  std::ofstream(folder_ / "text.png") << "not a picture";
  EXPECT_THROW(facemap::read_png(folder_ / "text.png"), Error);

  write_png(make_image(64, 64), folder_ / "whole.png");
  const std::string bytes = text_of(folder_ / "whole.png");
  for (const std::size_t kept : {std::size_t{7}, std::size_t{30}, bytes.size() / 2, bytes.size() - 20}) {
    std::ofstream(folder_ / "cut.png", std::ios::binary) << bytes.substr(0, kept);
    EXPECT_THROW(facemap::read_png(folder_ / "cut.png"), Error) << kept;
  }

  png_image grey{};
  grey.version = PNG_IMAGE_VERSION;
  grey.width = grey.height = 1;
  grey.format = PNG_FORMAT_GRAY;
  const png_byte level = 7;
  ASSERT_TRUE(png_image_write_to_file(&grey, (folder_ / "grey.png").c_str(), 0, &level, 0, nullptr));
  EXPECT_THROW(facemap::read_png(folder_ / "grey.png"), Error);
}

}  // namespace
