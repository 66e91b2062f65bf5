#include "scene/gltf_accessor.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/gltf_text.h"

namespace facemap {
namespace {

using Cause = LoadError::Cause;

/// Accessor 0 of a file, number by number.
std::vector<double> numbers_of(const GltfText& gltf, std::uint32_t index = 0) {
  const std::string name = "t.gltf", text = gltf.text("\"x\":" + std::to_string(index));
  const nlohmann::json json = parse_json(text, name);
  const std::filesystem::path folder = ".";
  const ModelLimits limits;
  ObjWarnings warnings(name);
  const GltfFile file{GltfValue(json, name), std::nullopt, text.size(), folder, limits, warnings};
  GltfBuffers buffers(file);
  GltfAccessors accessors(file, buffers);
  const GltfAccessor& accessor = accessors.open(index, file.root.at("x"));
  std::vector<double> numbers;
  for (std::uint32_t i = 0; i < accessor.count(); ++i) {
    for (int c = 0; c < accessor.components(); ++c) numbers.push_back(accessor.number(i, c));
  }
  return numbers;
}

void expect_refused(const GltfText& gltf, Cause cause, const std::string& part) {
  try {
    numbers_of(gltf);
    ADD_FAILURE() << "was read";
  } catch (const LoadError& error) {
    EXPECT_EQ(error.cause(), cause) << error.what();
    EXPECT_NE(error.reason().find(part), std::string::npos) << error.what();
  }
}

GltfText one(const std::string& bytes, int type, const char* shape, int count, const std::string& more = "") {
  GltfText gltf;
  gltf.accessor(bytes, type, shape, count, more);
  return gltf;
}

const std::string kNormalised = ",\"normalized\":true";

TEST(GltfAccessor, ReadsEveryComponentType) {
  EXPECT_EQ(numbers_of(one(bytes_of<std::int8_t>({-128, 127}), kInt8, "SCALAR", 2)), (std::vector<double>{-128, 127}));
  EXPECT_EQ(numbers_of(one(bytes_of<std::uint8_t>({0, 255}), kUint8, "VEC2", 1)), (std::vector<double>{0, 255}));
  EXPECT_EQ(numbers_of(one(bytes_of<std::int16_t>({-32768, 32767}), kInt16, "SCALAR", 2)),
            (std::vector<double>{-32768, 32767}));
  EXPECT_EQ(numbers_of(one(bytes_of<std::uint16_t>({0, 65535}), kUint16, "SCALAR", 2)),
            (std::vector<double>{0, 65535}));
  EXPECT_EQ(numbers_of(one(bytes_of<std::uint32_t>({0, 0xffffffff}), kUint32, "SCALAR", 2)),
            (std::vector<double>{0, 4294967295.0}));
  EXPECT_EQ(numbers_of(one(bytes_of<float>({-0.5f, 3}), kFloat32, "SCALAR", 2)), (std::vector<double>{-0.5, 3}));
}

TEST(GltfAccessor, NormalisesIntegers) {
  EXPECT_EQ(numbers_of(one(bytes_of<std::int8_t>({-128, -127, 0, 127}), kInt8, "SCALAR", 4, kNormalised)),
            (std::vector<double>{-1, -1, 0, 1}));
  EXPECT_EQ(numbers_of(one(bytes_of<std::uint8_t>({0, 51, 255}), kUint8, "SCALAR", 3, kNormalised)),
            (std::vector<double>{0, 51 / 255.0, 1}));
  EXPECT_EQ(numbers_of(one(bytes_of<std::int16_t>({-32768, 32767}), kInt16, "SCALAR", 2, kNormalised)),
            (std::vector<double>{-1, 1}));
  EXPECT_EQ(numbers_of(one(bytes_of<std::uint16_t>({0, 65535}), kUint16, "SCALAR", 2, kNormalised)),
            (std::vector<double>{0, 1}));
}

TEST(GltfAccessor, ReadsInterleavedElements) {
  GltfText gltf;
  const int view = gltf.view(bytes_of<float>({9, 1, 2, 9, 3, 4}), ",\"byteStride\":12");
  gltf.accessor("{\"bufferView\":" + std::to_string(view) +
                ",\"byteOffset\":4,\"componentType\":5126,\"type\":\"VEC2\",\"count\":2}");
  EXPECT_EQ(numbers_of(gltf), (std::vector<double>{1, 2, 3, 4}));
}

TEST(GltfAccessor, ReplacesSparseElements) {
  GltfText gltf;
  const int base = gltf.view(bytes_of<float>({10, 11, 12, 13}));
  const int indices = gltf.view(bytes_of<std::uint8_t>({1, 3})), values = gltf.view(bytes_of<float>({-1, -3}));
  const std::string sparse =
      ",\"componentType\":5126,\"type\":\"SCALAR\",\"count\":4,\"sparse\":{\"count\":2,\"indices\":"
      "{\"bufferView\":" +
      std::to_string(indices) + ",\"componentType\":5121},\"values\":{\"bufferView\":" + std::to_string(values) + "}}}";
  gltf.accessor("{\"bufferView\":" + std::to_string(base) + sparse);
  gltf.accessor("{\"name\":\"of zeros\"" + sparse);
  EXPECT_EQ(numbers_of(gltf, 0), (std::vector<double>{10, -1, 12, -3}));
  EXPECT_EQ(numbers_of(gltf, 1), (std::vector<double>{0, -1, 0, -3}));
}

TEST(GltfAccessor, RefusesSparseIndicesOutOfOrder) {
  for (const auto& indices :
       {bytes_of<std::uint8_t>({3, 1}), bytes_of<std::uint8_t>({1, 1}), bytes_of<std::uint8_t>({1, 4})}) {
    GltfText gltf;
    gltf.view(indices);
    gltf.view(bytes_of<float>({-1, -3}));
    gltf.accessor(
        "{\"componentType\":5126,\"type\":\"SCALAR\",\"count\":4,\"sparse\":{\"count\":2,\"indices\":{\"bufferView\":0,"
        "\"componentType\":5121},\"values\":{\"bufferView\":1}}}");
    expect_refused(gltf, Cause::BadIndex, "accessors[0].sparse.indices: do not ascend");
  }
}

TEST(GltfAccessor, HasZerosWithoutBytes) {
  GltfText gltf;
  gltf.accessor("{\"componentType\":5126,\"type\":\"VEC2\",\"count\":2}");
  EXPECT_EQ(numbers_of(gltf), (std::vector<double>(4, 0)));
}

TEST(GltfAccessor, RefusesMoreZerosThanTheFileHasBytes) {
  GltfText gltf;
  gltf.accessor("{\"componentType\":5126,\"type\":\"VEC2\",\"count\":4000000000}");
  expect_refused(gltf, Cause::TooLarge, "elements without bytes");
}

TEST(GltfAccessor, RefusesElementsBeyondItsBytes) {
  const std::string three = bytes_of<float>({1, 2, 3});
  expect_refused(one(three, kFloat32, "SCALAR", 4), Cause::TruncatedStatement,
                 "accessors[0]: 4 elements, of which 3 are there");
  expect_refused(one(three, kFloat32, "SCALAR", 3, ",\"byteOffset\":1"), Cause::TruncatedStatement, "2 are there");
  expect_refused(one(three, kFloat32, "SCALAR", 1, ",\"byteOffset\":18446744073709551615"), Cause::TruncatedStatement,
                 "0 are there");
  expect_refused(one(three, kFloat32, "SCALAR", -1), Cause::BadValue, "accessors[0].count: is not a whole number");
  expect_refused(one(three, 5124, "SCALAR", 1), Cause::BadValue, "accessors[0].componentType: is not");
  expect_refused(one(three, kFloat32, "MAT2", 1), Cause::BadValue, "\"MAT2\"");
  GltfText gltf;
  gltf.view(three, ",\"byteStride\":4");
  gltf.accessor("{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC2\",\"count\":1}");
  expect_refused(gltf, Cause::BadValue, "elements of 8 bytes, 4 bytes from one to the next");
}

TEST(GltfAccessor, RefusesStridesThatWrapAround) {
  GltfText gltf;
  gltf.view(bytes_of<float>({1, 2, 3}), ",\"byteStride\":9223372036854775808");
  gltf.accessor("{\"bufferView\":0,\"componentType\":5126,\"type\":\"SCALAR\",\"count\":3}");
  expect_refused(gltf, Cause::TruncatedStatement, "3 elements, of which 1 are there");
}

}  // namespace
}  // namespace facemap
