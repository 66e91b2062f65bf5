#include <facemap/image_file.h>
#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string_view>

#include "image/decode_pfm.h"
#include "support/planes.h"

namespace facemap {
namespace {

constexpr std::uint64_t kMaxPixels = 1 << 20;

using Bytes = std::vector<std::uint8_t>;

Bytes bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

std::vector<float> channel(const PictureChannels& picture, const char* name) {
  for (const auto& one : picture.channels) {
    if (one.name == name) return std::get<std::vector<float>>(one.values);
  }
  return {};
}

TEST(Pfm, BeginsWithTheLowestRow) {
  const std::vector<float> values = {1, 2, 3, 4};
  const Bytes bytes = encode_pfm({1, 4, 1, std::span(values)});
  const std::string_view header = "Pf\n1 4\n-1.0\n";
  ASSERT_EQ(bytes.size(), header.size() + 16);
  EXPECT_EQ(std::string_view(reinterpret_cast<const char*>(bytes.data()), header.size()), header);
  float first;
  std::memcpy(&first, bytes.data() + header.size(), sizeof first);
  EXPECT_EQ(first, 4);
}

TEST(Pfm, ReadsBackWhatItWrote) {
  TestPlane<float> plane(13, 7, 3);
  plane.values[5] = std::numeric_limits<float>::infinity();
  plane.values[6] = -1e-40f;
  const PictureChannels picture = decode_pfm(encode_pfm(plane.view()), "a.pfm", kMaxPixels);
  ASSERT_EQ(picture.width, 13);
  ASSERT_EQ(picture.height, 7);
  ASSERT_EQ(picture.channels.size(), 3u);
  const std::vector<float> rgb[] = {channel(picture, "R"), channel(picture, "G"), channel(picture, "B")};
  for (std::size_t i = 0; i < plane.values.size(); ++i) ASSERT_EQ(rgb[i % 3].at(i / 3), plane.values[i]) << i;

  const TestPlane<float> grey(5, 3, 1);
  EXPECT_EQ(channel(decode_pfm(encode_pfm(grey.view()), "a.pfm", kMaxPixels), "Y"), grey.values);
}

TEST(Pfm, ReadsTheOtherByteOrder) {
  const Bytes bytes = bytes_of(std::string_view("Pf 1 2 2.5\n\x3f\x80\0\0\x40\0\0\0", 19));
  EXPECT_EQ(channel(decode_pfm(bytes, "a.pfm", kMaxPixels), "Y"), (std::vector<float>{2, 1}));
}

TEST(Pfm, RefusesBrokenFiles) {
  const auto refusal = [](const Bytes& bytes) { return error_of([&] { decode_pfm(bytes, "a.pfm", kMaxPixels); }); };
  const Bytes whole = encode_pfm(TestPlane<float>(3, 2, 3).view());
  EXPECT_EQ(refusal(whole), "no error");
  for (std::size_t kept = 3; kept < whole.size(); ++kept) {
    EXPECT_EQ(refusal(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(kept))),
              "a.pfm: PFM cannot be read: it ends too early");
  }
  EXPECT_EQ(refusal(bytes_of("PF\n3 x\n-1\n")), "a.pfm: PFM cannot be read: its header is not three numbers");
  EXPECT_EQ(refusal(bytes_of("PF\n3 -3\n-1\n")), "a.pfm: PFM cannot be read: its header is not three numbers");
  EXPECT_EQ(refusal(bytes_of("PF\n0 3\n-1\n")), "a.pfm: the picture has no pixels");
  EXPECT_EQ(refusal(bytes_of("PF\n4000000000 4000000000\n-1\n")),
            "a.pfm: a picture of 4000000000x4000000000 pixels; at most 1048576 pixels are allowed");
}

TEST(Pfm, RefusesOtherPlanes) {
  EXPECT_EQ(error_of([] { encode_pfm(TestPlane<float>(3, 2, 2).view()); }), "PFM: the format has no 2 channels");
  EXPECT_EQ(error_of([] { encode_pfm(TestPlane<std::int32_t>(3, 2, 1).view()); }),
            "PFM: the plane is of another type than the format has");
}

}  // namespace
}  // namespace facemap
