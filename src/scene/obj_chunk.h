#pragma once

#include <facemap/mesh.h>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace facemap {

/// How many statements of each kind that faces refer to.
struct ObjCounts {
  std::int64_t vertices = 0;
  std::int64_t texture_coordinates = 0;
  std::int64_t normals = 0;

  friend ObjCounts operator+(const ObjCounts& a, const ObjCounts& b) {
    return {a.vertices + b.vertices, a.texture_coordinates + b.texture_coordinates, a.normals + b.normals};
  }
};

/// Some whole lines of an OBJ text, read apart from the others. It reads what most files hold and takes nothing that
/// is odd: errors, warnings, joined lines, colours and indices of what comes later are ObjReader's, which then reads
/// the whole text again from its head. Lines count from 0 here, triangles from the chunk's first.
class ObjChunk {
 public:
  /// A face of four corners or more, which stands in the arrays as a fan.
  struct Fan {
    std::uint32_t first_triangle;
    std::uint32_t corner_count;
    std::uint32_t line;
  };

  /// A statement of another kind, for ObjReader: up to the line's end, with kReadableBeyondEnd bytes behind.
  struct Statement {
    std::string text;
    std::uint32_t line;
    std::uint32_t first_triangle;  ///< that comes after it
  };

  enum class Outcome {
    Done,
    NeedsCounts,  ///< of what stands before the chunk, since an index counts backwards
    Odd,
  };

  /// Most bytes of a chunk: what is counted in 32 bits fits them.
  static constexpr std::size_t kMaxBytes = std::size_t{1} << 24;

  /// Reads `text`, which ends in '\n' and has kReadableBeyondEnd readable bytes behind it; it is not needed afterwards.
  /// For an outcome other than Done nothing else is told.
  Outcome read(std::string_view text, const std::optional<ObjCounts>& before);

  /// The counts that read() would find.
  static ObjCounts count(std::string_view text);

  /// Whether no index refers to what comes later, if `before` is what stands before the chunk.
  bool is_backward(const ObjCounts& before) const;

  ObjCounts counts;
  std::uint32_t lines = 0;
  std::uint32_t polygons = 0;
  std::vector<Vector> positions, normals;
  std::vector<glm::vec2> texture_coordinates;
  std::vector<Corners> triangles;
  std::vector<Corners> texture_corners, normal_corners;  ///< one a triangle, or empty
  std::vector<Fan> fans;
  std::vector<Statement> statements;

 private:
  struct Corner {
    std::uint32_t vertex, texture, normal;
  };

  void reserve(std::string_view text);
  const char* read_line(const char* at);
  const char* read_vector(const char* at, std::vector<Vector>& values, std::int64_t& count);
  const char* read_texture_coordinates(const char* at);
  const char* read_face(const char* at);
  const char* read_corner(const char* at, Corner& corner);
  const char* read_index(const char* at, std::int64_t ObjCounts::*kind, std::uint32_t& index);
  const char* read_negative_index(const char* at, std::int64_t ObjCounts::*kind, std::uint32_t& index);
  const char* read_other(const char* line, const char* at);
  const char* end_line(const char* at) const;
  void add_face();

  const char* end_ = nullptr;  ///< of the text
  std::optional<ObjCounts> before_;
  bool needs_counts_ = false;
  ObjCounts lacking_;  ///< so many of each kind stand before the chunk if no index refers to what comes later
  std::size_t statements_left_ = 0;
  std::vector<Corner> corners_;  ///< of the face being read
};

}  // namespace facemap
