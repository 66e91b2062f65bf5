#include <ImathBox.h>
#include <ImfChannelList.h>
#include <ImfChromaticities.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStandardAttributes.h>
#include <facemap/image_file.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string_view>

#include "image/decode_exr.h"
#include "support/planes.h"

namespace facemap {
namespace {

constexpr std::uint64_t kMaxPixels = 1 << 20;
constexpr float kInfinity = std::numeric_limits<float>::infinity();

using Bytes = std::vector<std::uint8_t>;

/// Colours as half, depths as float, ids as uint32, shadow counts as uint16.
struct Planes {
  TestPlane<float> colours{19, 37, 3}, depths{19, 37, 1};
  TestPlane<std::int32_t> ids{19, 37, 1};
  TestPlane<std::uint16_t> counts{19, 37, 1};

  Planes() {
    ids.values[0] = -1;
    depths.values[1] = kInfinity;
    colours.values[0] = 1e6f;
    colours.values[3] = -kInfinity;
  }

  std::vector<ExrLayers> layers() const {
    return {{{"R", "G", "B"}, colours.view(), ExrLayers::Storage::Half},
            {{"depth.Z"}, depths.view()},
            {{"id.face"}, ids.view()},
            {{"shadows.count"}, counts.view()}};
  }
};

template <typename Value>
std::vector<Value> channel(const PictureChannels& picture, const std::string& name) {
  for (const auto& one : picture.channels) {
    if (one.name == name) return std::get<std::vector<Value>>(one.values);
  }
  return {};
}

/// A file with these bytes `offset` behind the first place of `text`.
Bytes with_changed_header(std::string_view text, std::ptrdiff_t offset, const Bytes& changed) {
  Bytes bytes = encode_exr(Planes().layers());
  const auto at = std::search(bytes.begin(), bytes.end(), text.begin(), text.end());
  std::copy(changed.begin(), changed.end(), at + offset);
  return bytes;
}

TEST(Exr, ReadsBackWhatItWrote) {
  const Planes planes;
  const PictureChannels picture = decode_exr(encode_exr(planes.layers()), "a.exr", kMaxPixels);
  ASSERT_EQ(picture.width, 19);
  ASSERT_EQ(picture.height, 37);
  ASSERT_EQ(picture.channels.size(), 6u);
  EXPECT_EQ(channel<float>(picture, "depth.Z"), planes.depths.values);
  const std::vector<std::uint32_t> ids = channel<std::uint32_t>(picture, "id.face");
  EXPECT_TRUE(std::equal(ids.begin(), ids.end(), planes.ids.values.begin(), planes.ids.values.end(),
                         [](std::uint32_t a, std::int32_t b) { return a == static_cast<std::uint32_t>(b); }));
  EXPECT_EQ(ids[0], 4294967295u);
  const std::vector<std::uint32_t> counts = channel<std::uint32_t>(picture, "shadows.count");
  EXPECT_TRUE(std::equal(counts.begin(), counts.end(), planes.counts.values.begin(), planes.counts.values.end()));

  constexpr float kHalfRounding = 0x1p-12f;  // of values up to 1: half a unit in the last place
  const char* const names[] = {"R", "G", "B"};
  for (std::size_t k = 0; k < 3; ++k) {
    const std::vector<float> colours = channel<float>(picture, names[k]);
    for (std::size_t i = 2; i < colours.size(); ++i) {
      ASSERT_NEAR(colours[i], planes.colours.values[3 * i + k], kHalfRounding) << names[k] << i;
    }
  }
  EXPECT_EQ(channel<float>(picture, "R")[0], 65504) << "finite values stay finite";
  EXPECT_EQ(channel<float>(picture, "R")[1], -kInfinity);
}

TEST(Exr, BytesDoNotDependOnThreads) {
  const Planes planes;
  const Bytes bytes = encode_exr(planes.layers(), 1);
  for (const int threads : {0, 2, 5}) EXPECT_EQ(encode_exr(planes.layers(), threads), bytes);
}

TEST(Exr, LongNamesAndNoiseAreKept) {
  const TestPlane<float> noise(40, 20, 1);  // mantissas that do not compress
  const std::string longest(255, 'n');
  const ExrLayers layer{{longest}, noise.view()}, longer{{longest + "n"}, noise.view()};
  EXPECT_EQ(channel<float>(decode_exr(encode_exr({&layer, 1}), "a.exr", kMaxPixels), longest), noise.values);
  EXPECT_EQ(error_of([&] { encode_exr({&longer, 1}); }), "EXR: the name of a channel is too long");
}

TEST(Exr, HeaderSaysWhatTheFileHolds) {
  const Planes planes;
  std::string name = (std::filesystem::temp_directory_path() / "facemap-exr-XXXXXX").string();
  ::close(::mkstemp(name.data()));
  write_file(name, encode_exr(planes.layers()));
  const Imf::InputFile file(name.c_str());
  std::filesystem::remove(name);
  const Imf::Header& header = file.header();
  const Imath::Box2i window({0, 0}, {18, 36});
  EXPECT_EQ(header.dataWindow(), window);
  EXPECT_EQ(header.displayWindow(), window);
  EXPECT_EQ(header.compression(), Imf::ZIP_COMPRESSION);
  EXPECT_EQ(header.channels()["R"].type, Imf::HALF);
  EXPECT_EQ(header.channels()["depth.Z"].type, Imf::FLOAT);
  EXPECT_EQ(header.channels()["id.face"].type, Imf::UINT);
  ASSERT_TRUE(Imf::hasChromaticities(header));
  const Imf::Chromaticities primaries = Imf::chromaticities(header);
  EXPECT_FLOAT_EQ(primaries.red.x, 0.64f);
  EXPECT_FLOAT_EQ(primaries.green.y, 0.6f);
  EXPECT_FLOAT_EQ(primaries.white.x, 0.3127f);
  EXPECT_TRUE(file.isComplete());
}

TEST(Exr, RefusesOtherPlanes) {
  const auto refusal = [](const std::vector<ExrLayers>& layers) { return error_of([&] { encode_exr(layers); }); };
  const TestPlane<float> plane(4, 4, 2), other(4, 5, 1);
  const TestPlane<std::int32_t> ids(4, 4, 1);
  EXPECT_EQ(refusal({}), "EXR: there are no layers");
  EXPECT_EQ(refusal({{{"a"}, plane.view()}}), "EXR: a plane has not as many names as channels");
  EXPECT_EQ(refusal({{{"a", "a"}, plane.view()}}), "EXR: a layer's name is empty or there twice");
  EXPECT_EQ(refusal({{{"a", ""}, plane.view()}}), "EXR: a layer's name is empty or there twice");
  EXPECT_EQ(refusal({{{"a", "b"}, plane.view()}, {{"c"}, other.view()}}), "EXR: the planes are of different sizes");
  EXPECT_EQ(refusal({{{"a"}, ids.view(), ExrLayers::Storage::Half}}), "EXR: whole numbers are not stored as half");
}

TEST(Exr, RefusesBrokenFiles) {
  const auto refusal = [](const Bytes& bytes) { return error_of([&] { decode_exr(bytes, "a.exr", kMaxPixels); }); };
  const Bytes whole = encode_exr(Planes().layers());
  for (std::size_t kept = 4; kept < whole.size(); kept += 1 + kept / 40) {
    const std::string reason = refusal(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(kept)));
    EXPECT_EQ(reason.find("a.exr: EXR cannot be read: "), 0u) << kept << ": " << reason;
  }
  Bytes several = whole;
  several[5] |= 0x10;
  EXPECT_EQ(refusal(several), "a.exr: EXR cannot be read: files of several parts or of deep pixels are not read");

  // Behind "dataWindow", "box2i", the size, the other corner: 2^24 - 1.
  const Bytes large = with_changed_header("dataWindow", 11 + 6 + 4 + 8, {0xff, 0xff, 0xff});
  EXPECT_EQ(refusal(large), "a.exr: a picture of 16777216x37 pixels; at most 1048576 pixels are allowed");
}

TEST(Exr, AttributesThatPromiseMuchTakeNoMemory) {
  const auto refusal = [](const Bytes& bytes) { return error_of([&] { decode_exr(bytes, "a.exr", kMaxPixels); }); };
  const std::ptrdiff_t size = 15 + 15;  // behind name and type of "chromaticities"
  EXPECT_EQ(refusal(with_changed_header("chromaticities", size, {0, 0, 0, 0x70})),
            "a.exr: EXR cannot be read: it ends too early");
  EXPECT_EQ(refusal(with_changed_header("chromaticities", 15, {'p', 'r', 'e', 'v', 'i', 'e', 'w'})), "no error")
      << "of another type";
  EXPECT_EQ(refusal(with_changed_header("dataWindow", 11 + 6, {17})),
            "a.exr: EXR cannot be read: its attribute dataWindow is of another type or size");
  EXPECT_EQ(refusal(with_changed_header("channels", 9, {'x'})),
            "a.exr: EXR cannot be read: its attribute channels is of another type or size");
}

}  // namespace
}  // namespace facemap
