// Golden pictures of one small model from a file of each format (support/golden.h).

#include <facemap/image.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "support/gltf_text.h"
#include "support/golden.h"

namespace facemap {
namespace {

namespace fs = std::filesystem;

// A pyramid over a square: position, texture coordinates, colour of each vertex. All numbers are exact in binary.
struct Vertex {
  float x, y, z, u, v;
  int red, green, blue;
};
constexpr std::array<Vertex, 9> kVertices{{{-2, 0, -2, 0, 0, 255, 0, 0},
                                           {2, 0, -2, 1, 0, 0, 255, 0},
                                           {2, 0, 2, 1, 1, 0, 0, 255},
                                           {-2, 0, 2, 0, 1, 255, 255, 255},
                                           {-1, 0.5f, -1, 0, 0, 255, 255, 0},
                                           {1, 0.5f, -1, 1, 0, 0, 255, 255},
                                           {1, 0.5f, 1, 1, 1, 255, 0, 255},
                                           {-1, 0.5f, 1, 0, 1, 0, 0, 0},
                                           {0, 1.75f, 0, 0.5f, 0.5f, 255, 255, 255}}};
constexpr std::array<std::array<int, 3>, 6> kFaces{{{0, 2, 1}, {0, 3, 2}, {4, 8, 5}, {5, 8, 6}, {6, 8, 7}, {7, 8, 4}}};

std::string texture_file() {
  Image image;
  image.width = image.height = 2;
  for (const std::uint32_t rgb : {0xff4020, 0x20ff40, 0x4020ff, 0xffffff}) {
    image.pixels.push_back(Color::from_24_bit(rgb));
  }
  const std::vector<std::uint8_t> bytes = encode_png(image, 1);
  return {bytes.begin(), bytes.end()};
}

void write(const fs::path& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

std::string obj_text() {
  std::ostringstream out;
  out << "mtllib model.mtl\no pyramid\nusemtl painted\n";
  for (const Vertex& p : kVertices)
    out << "v " << p.x << ' ' << p.y << ' ' << p.z << "\nvt " << p.u << ' ' << p.v << '\n';
  for (const auto& face : kFaces) {
    out << 'f';
    for (const int corner : face) out << ' ' << corner + 1 << '/' << corner + 1;
    out << '\n';
  }
  return out.str();
}
constexpr const char* kMtl = "newmtl painted\nKd 0.75 0.5 1\nKs 0.25 0.25 0.25\nNs 16\nmap_Kd texture.png\n";

struct GltfBytes {
  std::string positions, coordinates, indices;
};
GltfBytes gltf_bytes() {
  GltfBytes bytes;
  for (const Vertex& p : kVertices) {
    bytes.positions += bytes_of({p.x, p.y, p.z});
    bytes.coordinates += bytes_of({p.u, p.v});
  }
  for (const auto& face : kFaces) {
    for (const int corner : face) bytes.indices += bytes_of({static_cast<std::uint16_t>(corner)});
  }
  return bytes;
}

// What the glTF file and the GLB file share: all but buffers, views and accessors.
const char* const kGltfMembers = R"("images":[{"uri":"texture.png"}],"textures":[{"source":0}],
"materials":[{"doubleSided":true,"pbrMetallicRoughness":{"baseColorTexture":{"index":0},"metallicFactor":0.25,"roughnessFactor":0.5}}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"indices":2,"material":0}]}],
"nodes":[{"mesh":0,"name":"pyramid"}],"scenes":[{"nodes":[0]}],"scene":0)";

std::string gltf_text() {
  const GltfBytes bytes = gltf_bytes();
  GltfText gltf;
  gltf.accessor(bytes.positions, kFloat32, "VEC3", 9);
  gltf.accessor(bytes.coordinates, kFloat32, "VEC2", 9);
  gltf.accessor(bytes.indices, kUint16, "SCALAR", 18);
  return gltf.text(kGltfMembers);
}

std::string glb_bytes() {
  const GltfBytes bytes = gltf_bytes();  // 108, 72 and 36 bytes
  std::string json = R"({"asset":{"version":"2.0"},"buffers":[{"byteLength":216}],
"bufferViews":[{"buffer":0,"byteLength":108},{"buffer":0,"byteOffset":108,"byteLength":72},{"buffer":0,"byteOffset":180,"byteLength":36}],
"accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":9},{"bufferView":1,"componentType":5126,"type":"VEC2","count":9},
{"bufferView":2,"componentType":5123,"type":"SCALAR","count":18}],)";
  json += kGltfMembers;
  json += '}';
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string binary = bytes.positions + bytes.coordinates + bytes.indices;
  const auto size = [](const std::string& text) { return static_cast<std::uint32_t>(text.size()); };
  constexpr std::uint32_t kHead = 12, kChunkHead = 8;
  return "glTF" + bytes_of<std::uint32_t>({2, kHead + 2 * kChunkHead + size(json) + size(binary), size(json)}) +
         "JSON" + json + bytes_of<std::uint32_t>({size(binary)}) + std::string("BIN\0", 4) + binary;
}

enum class PlyBody { Text, LittleEndian, BigEndian };

template <class Number>
std::string ordered_bytes(Number number, PlyBody order) {
  std::string bytes = bytes_of({number});
  if (order == PlyBody::BigEndian) std::reverse(bytes.begin(), bytes.end());
  return bytes;
}

std::string ply_bytes(PlyBody body) {
  constexpr const char* kNames[] = {"ascii", "binary_little_endian", "binary_big_endian"};
  std::ostringstream out;
  out << "ply\nformat " << kNames[static_cast<int>(body)] << " 1.0\nelement vertex 9\n";
  for (const char* name : {"float x", "float y", "float z", "uchar red", "uchar green", "uchar blue"}) {
    out << "property " << name << '\n';
  }
  out << "element face 6\nproperty list uchar int vertex_indices\nend_header\n";
  const auto put = [&](auto number) {
    if (body != PlyBody::Text) {
      out << ordered_bytes(number, body);
    } else {
      out << +number << ' ';
    }
  };
  for (const Vertex& p : kVertices) {
    for (const float coordinate : {p.x, p.y, p.z}) put(coordinate);
    for (const int level : {p.red, p.green, p.blue}) put(static_cast<std::uint8_t>(level));
    if (body == PlyBody::Text) out << '\n';
  }
  for (const auto& face : kFaces) {
    put(std::uint8_t{3});
    for (const int corner : face) put(std::int32_t{corner});
    if (body == PlyBody::Text) out << '\n';
  }
  return out.str();
}

std::string stl_text() {
  std::ostringstream out;
  out << "solid pyramid\n";
  for (const auto& face : kFaces) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const int corner : face) {
      const Vertex& p = kVertices[static_cast<std::size_t>(corner)];
      out << "vertex " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    }
    out << "endloop\nendfacet\n";
  }
  out << "endsolid pyramid\n";
  return out.str();
}

std::string stl_bytes() {
  std::string bytes = std::string(80, ' ') + bytes_of<std::uint32_t>({6});
  for (const auto& face : kFaces) {
    bytes += bytes_of<float>({0, 0, 0});
    for (const int corner : face) {
      const Vertex& p = kVertices[static_cast<std::size_t>(corner)];
      bytes += bytes_of({p.x, p.y, p.z});
    }
    bytes += std::string(2, '\0');
  }
  return bytes;
}

// Without materials all formats give one picture.
constexpr std::uint64_t kShape = 0xbe0d72dea35fb15b;

struct GoldenFile {
  const char* name;
  std::uint64_t hash;
  std::string bytes;
};

golden::Subject subject_of_files() {
  golden::Subject subject = golden::make_subject();
  subject.view.position = {1.5f, 2.5f, 4};
  subject.view.look_at = {0, 0.25f, 0};
  return subject;
}

class Folder {
 public:
  Folder() {
    std::string name = (fs::temp_directory_path() / "facemap-golden-XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { fs::remove_all(path_); }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

TEST(GoldenModels, OfEachFormat) {
  const GoldenFile table[] = {
      {"model.obj", 0x2a32d9e97ce68a79, obj_text()},
      {"model.gltf", 0x9886a11218c148c1, gltf_text()},
      {"model.glb", 0x9886a11218c148c1, glb_bytes()},
      {"text.ply", 0x21a430fc798dd7c2, ply_bytes(PlyBody::Text)},
      {"little.ply", 0x21a430fc798dd7c2, ply_bytes(PlyBody::LittleEndian)},
      {"big.ply", 0x21a430fc798dd7c2, ply_bytes(PlyBody::BigEndian)},
      {"text.stl", 0x720f17c5ea8689e2, stl_text()},
      {"binary.stl", 0xf5773e60f88ece52, stl_bytes()},
  };
  const Folder folder;
  write(folder.path() / "model.mtl", kMtl);
  write(folder.path() / "texture.png", texture_file());
  const golden::Subject subject = subject_of_files();
  golden::Subject bare = subject;
  bare.options.materials = false;
  bare.options.planes = {Plane::Id, Plane::Depth, Plane::FaceNormal, Plane::Lights};
  for (const GoldenFile& file : table) {
    SCOPED_TRACE(file.name);
    write(folder.path() / file.name, file.bytes);
    const Scene scene = Scene::load(folder.path() / file.name, 1);
    EXPECT_TRUE(scene.report().warnings.empty());
    golden::expect_hash(file.name, file.hash, scene, subject);
    golden::expect_hash("the shape alone", kShape, scene, bare);
  }
}

}  // namespace
}  // namespace facemap
