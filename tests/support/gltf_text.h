#pragma once

#include <cstdint>
#include <cstring>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace facemap {

/// The bytes of numbers, one after the other.
template <class Number>
std::string bytes_of(std::initializer_list<Number> numbers) {
  std::string bytes(numbers.size() * sizeof(Number), '\0');
  if (numbers.size() > 0) std::memcpy(bytes.data(), numbers.begin(), bytes.size());
  return bytes;
}

inline std::string base64(std::string_view bytes) {
  constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : bytes) {
    bits = bits << 8 | static_cast<unsigned char>(c);
    for (count += 8; count >= 6; count -= 6) text += kDigits[bits >> (count - 6) & 63];
  }
  if (count > 0) text += kDigits[bits << (6 - count) & 63];
  while (text.size() % 4 != 0) text += '=';
  return text;
}

/// Makes small glTF files: its buffers are data URIs, each with one bufferView and one accessor.
class GltfText {
 public:
  /// Appends an accessor and returns its index. `more` are members, with a comma before them.
  int accessor(const std::string& bytes, int component_type, const char* type, int count,
               const std::string& more = "") {
    const int index = view(bytes);
    accessors_.push_back("{\"bufferView\":" + std::to_string(index) +
                         ",\"componentType\":" + std::to_string(component_type) + ",\"type\":\"" + type +
                         "\",\"count\":" + std::to_string(count) + more + "}");
    return static_cast<int>(accessors_.size()) - 1;
  }

  /// The same for an accessor that is written out.
  int accessor(const std::string& text) {
    accessors_.push_back(text);
    return static_cast<int>(accessors_.size()) - 1;
  }

  int view(const std::string& bytes, const std::string& more = "") {
    const std::string size = std::to_string(bytes.size()), index = std::to_string(views_.size());
    buffers_.push_back("{\"byteLength\":" + size + ",\"uri\":\"data:application/octet-stream;base64," + base64(bytes) +
                       "\"}");
    views_.push_back("{\"buffer\":" + index + ",\"byteLength\":" + size + more + "}");
    return static_cast<int>(views_.size()) - 1;
  }

  /// The file's text; `members` are those of the file itself beside asset, buffers, bufferViews and accessors.
  std::string text(const std::string& members) const {
    return "{\"asset\":{\"version\":\"2.0\"},\n\"buffers\":[" + join(buffers_) + "],\n\"bufferViews\":[" +
           join(views_) + "],\n\"accessors\":[" + join(accessors_) + "],\n" + members + "}\n";
  }

 private:
  static std::string join(const std::vector<std::string>& parts) {
    std::string text;
    for (const std::string& part : parts) text += (text.empty() ? "" : ",\n") + part;
    return text;
  }

  std::vector<std::string> buffers_, views_, accessors_;
};

constexpr int kInt8 = 5120, kUint8 = 5121, kInt16 = 5122, kUint16 = 5123, kUint32 = 5125, kFloat32 = 5126;

/// One triangle (0 0 0, 1 0 0, 0 1 0) at accessor 0, and one node with it.
inline GltfText triangle_text() {
  GltfText gltf;
  gltf.accessor(bytes_of<float>({0, 0, 0, 1, 0, 0, 0, 1, 0}), kFloat32, "VEC3", 3);
  return gltf;
}
inline const std::string kTriangleMesh = "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0}}]}]";

}  // namespace facemap
