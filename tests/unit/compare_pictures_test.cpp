#include <facemap/compare.h>
#include <facemap/image_file.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>

#include "support/planes.h"

namespace facemap {
namespace {

namespace fs = std::filesystem;
using Unit = PictureChannels::Unit;

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr double kEndless = std::numeric_limits<double>::infinity();

/// 2 x 2 pixels of one channel.
PictureChannels one_channel(std::vector<float> values, Unit unit = Unit::Values) {
  return {"a", 2, 2, unit, {{"Y", std::move(values)}}};
}

TEST(ComparePictures, EqualOnesDifferByNothing) {
  const PictureChannels a = one_channel({1, std::nanf(""), kInfinity, -0.0f}),
                        b = one_channel({1, -std::nanf(""), kInfinity, 0.0f});
  const Comparison comparison = compare_pictures(a, b);
  EXPECT_EQ(comparison.largest, 0);
  EXPECT_EQ(comparison.mean, 0);
  EXPECT_EQ(comparison.different, 0u);
  EXPECT_EQ(comparison.psnr, kEndless);
  EXPECT_EQ(comparison.largest_channel, "");
}

TEST(ComparePictures, MeasuresByHand) {
  const PictureChannels a{
      "a", 2, 2, Unit::Levels, {{"G", std::vector<float>{0, 10, 20, 30}}, {"R", std::vector<float>(4)}}};
  const PictureChannels b{
      "b", 2, 2, Unit::Levels, {{"G", std::vector<float>{0, 12, 20, 30}}, {"R", std::vector<float>{0, 1, 0, 5}}}};
  const Comparison comparison = compare_pictures(a, b, 2);
  EXPECT_EQ(comparison.largest, 5);
  EXPECT_EQ(comparison.largest_channel, "R");
  EXPECT_EQ(comparison.largest_x, 1);
  EXPECT_EQ(comparison.largest_y, 1);
  EXPECT_EQ(comparison.mean, 1);  // (2 + 1 + 5) / 8
  EXPECT_EQ(comparison.different, 2u);
  EXPECT_EQ(comparison.beyond, 1u) << "2 is not beyond 2";
  EXPECT_EQ(compare_pictures(a, b, 1.5).beyond, 2u);
  constexpr double kRounding = 1e-12;  // decibels: the C library's logarithm
  EXPECT_NEAR(comparison.psnr, 10 * std::log10(255 * 255 / ((4 + 1 + 25) / 8.0)), kRounding);
}

TEST(ComparePictures, WhatIsNoNumberIsInfinitelyFar) {
  const PictureChannels a = one_channel({1, 1, 1, 1}), b = one_channel({1, std::nanf(""), 1, 1}),
                        c = one_channel({1, kInfinity, 1, 1}), d = one_channel({1, -kInfinity, 1, 1});
  for (const auto& [one, other] : {std::pair(a, b), std::pair(a, c), std::pair(b, c), std::pair(c, d)}) {
    EXPECT_EQ(compare_pictures(one, other).largest, kEndless);
    EXPECT_EQ(compare_pictures(one, other).mean, kEndless);
    EXPECT_EQ(compare_pictures(one, other).psnr, -kEndless);
    EXPECT_EQ(compare_pictures(one, other, 1e300).beyond, 1u);
  }
}

TEST(ComparePictures, KeepsAllBitsOfWholeNumbers) {
  PictureChannels a{"a", 1, 1, Unit::Values, {{"id", std::vector<std::uint32_t>{16777216}}}}, b = a;
  std::get<1>(b.channels[0].values)[0] = 16777217;  // the same as float
  EXPECT_EQ(compare_pictures(a, b).largest, 1);
}

TEST(ComparePictures, ARestWithoutAlphaIsOpaque) {
  const PictureChannels a{"a", 1, 1, Unit::Levels, {{"R", std::vector<float>{7}}}};
  const PictureChannels b{"b", 1, 1, Unit::Levels, {{"A", std::vector<float>{250}}, {"R", std::vector<float>{7}}}};
  EXPECT_EQ(compare_pictures(a, b).largest, 5);
  EXPECT_EQ(compare_pictures(b, a).largest_channel, "A");
}

TEST(ComparePictures, SaysHowPicturesOfTwoKindsDiffer) {
  const PictureChannels a{"a", 2, 2, Unit::Values, {{"R", std::vector<float>(4)}}};
  PictureChannels other = a;
  other.name = "b";
  other.width = 1;
  other.height = 4;
  EXPECT_EQ(error_of([&] { compare_pictures(a, other); }), "a has 2x2 pixels, b has 1x4 pixels");
  other = a;
  other.unit = Unit::Levels;
  EXPECT_EQ(error_of([&] { compare_pictures(a, other); }), "a has values (PFM, EXR), a has levels (PNG, JPEG)");
  other = a;
  other.channels.insert(other.channels.begin(), {"B", std::vector<float>(4)});
  EXPECT_EQ(error_of([&] { compare_pictures(a, other); }), "a has the channels R, a has the channels B R");
  EXPECT_EQ(error_of([&] { difference_picture(other, a); }), "a has the channels B R, a has the channels R");
}

TEST(ComparePictures, ShowsWhereTheDifferencesAre) {
  const PictureChannels a{
      "a", 2, 2, Unit::Levels, {{"G", std::vector<float>{0, 10, 20, 30}}, {"R", std::vector<float>(4)}}};
  const PictureChannels b{
      "b", 2, 2, Unit::Levels, {{"G", std::vector<float>{0, 10.01f, 20, 32}}, {"R", std::vector<float>{0, 0, 4, 0}}}};
  const Image image = difference_picture(a, b);
  ASSERT_EQ(image.pixels.size(), 4u);
  EXPECT_EQ(image.pixels[0].to_24_bit(), 0x000000u);
  EXPECT_EQ(image.pixels[1].to_24_bit(), 0x000100u) << "a small difference shows";
  EXPECT_EQ(image.pixels[2].to_24_bit(), 0xff0000u);
  EXPECT_EQ(image.pixels[3].to_24_bit(), 0x008000u);
  const Image grey = difference_picture(one_channel({0, 1, 2, kInfinity}), one_channel({0, 0, 0, 0}));
  EXPECT_EQ(grey.pixels[1].to_24_bit(), 0x808080u);
  EXPECT_EQ(grey.pixels[3].to_24_bit(), 0xffffffu);
}

/// The same picture in every format, read back from files.
class ReadPicture : public testing::Test {
 protected:
  ReadPicture() {
    std::string name = (fs::temp_directory_path() / "facemap-compare-XXXXXX").string();
    folder_ = mkdtemp(name.data());
  }
  ~ReadPicture() override { fs::remove_all(folder_); }

  PictureChannels round_trip(const std::vector<std::uint8_t>& bytes) const {
    write_file(folder_ / "picture", bytes);
    return read_picture(folder_ / "picture");
  }

  fs::path folder_;
};

TEST_F(ReadPicture, ReadsEveryFormatWhateverItsName) {
  const TestPlane<float> values(9, 5, 3);
  ExrLayers layers{{"R", "G", "B"}, values.view()};
  const PictureChannels pfm = round_trip(encode_pfm(values.view())), exr = round_trip(encode_exr({&layers, 1}));
  EXPECT_EQ(pfm.unit, Unit::Values);
  EXPECT_EQ(compare_pictures(pfm, exr).largest, 0);

  Image image;
  image.width = 9;
  image.height = 5;
  for (std::size_t i = 0; i < 45; ++i)
    image.pixels.push_back({values.values[3 * i], values.values[3 * i + 1], values.values[3 * i + 2]});
  const std::vector<std::uint8_t> levels = levels_8(image);
  const std::vector<std::uint16_t> levels_of_16 = levels_16(image, Transfer::Srgb);
  const PictureChannels png = round_trip(encode_png(image));
  const PictureChannels png_16 = round_trip(encode_png_16({9, 5, 3, std::span(levels_of_16)}, Transfer::Srgb));
  const PictureChannels jpeg = round_trip(encode_jpeg({9, 5, 3, std::span(levels)}, 100));
  EXPECT_EQ(png.unit, Unit::Levels);
  EXPECT_EQ(png.channels.size(), 3u) << "no alpha where all is opaque";
  const double rounding = compare_pictures(png, png_16).largest;
  EXPECT_GT(rounding, 0) << "16 bits are kept";
  constexpr double kHalfLevels = 0.5 + 0.5 / 257;  // of 8 bits and of 16
  EXPECT_LE(rounding, kHalfLevels);
  constexpr double kJpegRounding = 3;
  EXPECT_LE(compare_pictures(png, jpeg).largest, kJpegRounding);
}

TEST_F(ReadPicture, RefusesWithAReason) {
  std::ofstream(folder_ / "text") << "not a picture";
  const std::string folder = folder_.string();
  EXPECT_EQ(error_of([&] { read_picture(folder_ / "text"); }), folder + "/text: it is neither PNG, JPEG, PFM nor EXR");
  EXPECT_EQ(error_of([&] { read_picture(folder_ / "absent"); }),
            folder + "/absent: cannot open: No such file or directory");
  EXPECT_EQ(error_of([&] { read_picture(folder_); }), folder + ": cannot open: it is a folder");
}

}  // namespace
}  // namespace facemap
