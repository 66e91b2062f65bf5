#include <facemap/error.h>
#include <facemap/image_file.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <limits>

#include "support/planes.h"

namespace {

namespace fs = std::filesystem;
using facemap::Image;

/// A file name of its own for each test, removed afterwards.
class Npy : public testing::Test {
 protected:
  Npy() {
    std::string name = (fs::temp_directory_path() / "facemap-npy-XXXXXX").string();
    folder_ = mkdtemp(name.data());
    path_ = folder_ / "plane.npy";
  }
  ~Npy() override { fs::remove_all(folder_); }

  /// Checks magic, version and alignment; splits the file into its dictionary and its data.
  void read() {
    std::ifstream in(path_, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    ASSERT_EQ(bytes.substr(0, 8), std::string("\x93NUMPY\x01\x00", 8));
    const std::size_t size = static_cast<unsigned char>(bytes[8]) + 256u * static_cast<unsigned char>(bytes[9]);
    EXPECT_EQ((10 + size) % 64, 0u);
    EXPECT_EQ(bytes[10 + size - 1], '\n');
    dictionary_ = bytes.substr(10, bytes.find('}') - 9);
    data_ = bytes.substr(10 + size);
  }

  template <typename Value>
  std::vector<Value> values() const {
    std::vector<Value> result(data_.size() / sizeof(Value));
    std::memcpy(result.data(), data_.data(), data_.size());
    return result;
  }

  fs::path folder_, path_;
  std::string dictionary_, data_;
};

Image make_image() {
  Image image;
  image.width = 3;
  image.height = 2;
  image.light_count = 9;
  image.ids = {0, 1, -1, 3, 2147483647, 5};
  image.depths = {0.5f, 1, 2, std::numeric_limits<float>::infinity(), 4, 5};
  image.lights = {1, 0, 2, 1, 255, 1, 0, 0, 128, 0, 7, 1};
  return image;
}

TEST_F(Npy, WritesIds) {
  facemap::write_npy(make_image(), facemap::Plane::Id, path_);
  read();
  EXPECT_EQ(dictionary_, "{'descr': '<i4', 'fortran_order': False, 'shape': (2, 3), }");
  EXPECT_EQ(values<std::int32_t>(), make_image().ids);
}

TEST_F(Npy, WritesDepths) {
  facemap::write_npy(make_image(), facemap::Plane::Depth, path_);
  read();
  EXPECT_EQ(dictionary_, "{'descr': '<f4', 'fortran_order': False, 'shape': (2, 3), }");
  EXPECT_EQ(values<float>(), make_image().depths);
}

TEST_F(Npy, WritesLightsWithTwoBytesForNineLights) {
  facemap::write_npy(make_image(), facemap::Plane::Lights, path_);
  read();
  EXPECT_EQ(dictionary_, "{'descr': '|u1', 'fortran_order': False, 'shape': (2, 3, 2), }");
  EXPECT_EQ(values<std::uint8_t>(), make_image().lights);
}

TEST_F(Npy, WritesPlanesOfAnyTypeAndDepth) {
  const auto write = [&](const facemap::PlaneView& plane, facemap::NpyShape shape) {
    facemap::write_file(path_, facemap::encode_npy(plane, shape));
    read();
  };
  using facemap::NpyShape;
  const TestPlane<float> normals(5, 3, 3);
  write(normals.view(), NpyShape::ByChannels);
  EXPECT_EQ(dictionary_, "{'descr': '<f4', 'fortran_order': False, 'shape': (3, 5, 3), }");
  EXPECT_EQ(values<float>(), normals.values);
  const TestPlane<std::uint16_t> counts(5, 3, 1);
  write(counts.view(), NpyShape::ByChannels);
  EXPECT_EQ(dictionary_, "{'descr': '<u2', 'fortran_order': False, 'shape': (3, 5), }");
  EXPECT_EQ(values<std::uint16_t>(), counts.values);
  const TestPlane<std::uint8_t> bits(5, 3, 1);
  write(bits.view(), NpyShape::AlwaysThree);
  EXPECT_EQ(dictionary_, "{'descr': '|u1', 'fortran_order': False, 'shape': (3, 5, 1), }");
  EXPECT_EQ(values<std::uint8_t>(), bits.values);
  EXPECT_EQ(error_of([] {
              facemap::encode_npy({2, 2, 1, std::span<const float>()});
            }),
            "NPY: the plane has other values than it says");
}

TEST_F(Npy, RefusesAPlaneThatWasNotAskedFor) {
  Image image = make_image();
  image.ids.clear();
  EXPECT_EQ(error_of([&] { facemap::write_npy(image, facemap::Plane::Id, path_); }),
            path_.string() + ": the image has no plane of id");
  EXPECT_FALSE(fs::exists(path_));
  EXPECT_THROW(facemap::write_npy(image, facemap::Plane::Depth, "/dev/full"), facemap::Error);
}

}  // namespace
