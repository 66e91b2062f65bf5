#pragma once

#include <facemap/error.h>
#include <facemap/mesh.h>
#include <facemap/obj.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "parallel/executor.h"
#include "scene/file_mapping.h"
#include "scene/obj_chunks.h"
#include "scene/obj_faces.h"
#include "scene/obj_lines.h"
#include "scene/obj_materials.h"
#include "scene/obj_objects.h"
#include "scene/obj_warnings.h"
#include "scene/smooth_normals.h"

namespace facemap {

/// What a file holds, but for the normals that smoothing groups ask for: add_smooth_normals makes them.
struct ObjModel {
  Mesh mesh;
  std::vector<Material> materials;
  std::vector<TextureImage> images;
  std::vector<std::string> objects;  ///< names
  std::vector<ObjectRun> object_runs;
  OBJ::Report report;
  std::vector<SmoothingRun> smoothing;
};

/// As OBJ::load, of a file that is open and will be closed when it has been read.
ObjModel load_obj(std::optional<FileMapping>& file, const std::filesystem::path& path, const OBJ::Limits& limits);

/// Reads the statements of an OBJ text into a mesh: one line after the other, or a large text without oddities in
/// chunks by several threads, with the same outcome.
class ObjReader {
 public:
  ObjReader(std::string_view text, std::string name, const std::filesystem::path& directory, const OBJ::Limits& limits);

  /// Reads all statements; the text is not needed any more, and parts of it are told to `release` as they are done
  /// with, by several threads. Throws LoadError, as does finish().
  void read(const ObjChunks::Release& release = {});

  /// Checks what only the whole file can show, and gives what was read. Call it once.
  ObjModel finish();

 private:
  /// A positive index may name what comes later in the file. Those that go further ahead than any before are
  /// kept: the first of them that is too large in the end is the first wrong index of the file.
  struct ForwardIndex {
    std::int64_t index;  ///< from 1
    std::int64_t line;
  };
  struct IndexKind {
    const char* noun;
    std::vector<ForwardIndex> forward;
  };

  bool read_in_chunks(const ObjChunks::Release& release);
  void merge_chunks();
  void read_statement();
  void read_other_statement(const char* at);
  void read_vertex(const char* at);
  void read_colour(const char* at);
  void read_normal(const char* at);
  void read_texture_coordinates(const char* at);
  void read_face(const char* at);
  void read_smoothing_group(const char* at);
  const char* read_corner(const char* at, ObjCorner& corner);
  const char* read_index(const char* at, std::size_t count, IndexKind& kind, std::uint32_t& index);
  const char* read_odd_index(const char* at, std::size_t count, IndexKind& kind, std::uint32_t& index);
  const char* read_float(const char* at, float& value);
  int read_floats(const char* at, float* values, int most);
  void note_forward(std::int64_t index, IndexKind& kind);
  void ignore(std::string_view keyword);
  void check_forward(const IndexKind& kind, std::size_t count) const;

  [[noreturn]] void fail(LoadError::Cause cause, const std::string& reason) const;
  [[noreturn]] void fail_number(const char* token) const;

  ObjModel model_;
  std::string name_;
  OBJ::Limits limits_;
  std::string_view text_;  ///< until read() is done
  ObjLines lines_;
  std::int64_t line_ = 0;          ///< the statement's that is being read
  std::size_t next_triangle_ = 0;  ///< the first that comes after it; for statements that are no faces
  ObjWarnings warnings_;
  ObjMaterials mtl_;
  ObjObjects objects_;
  ObjFaces faces_;
  std::optional<Executor> executor_;  ///< if there are chunks
  ObjChunks chunks_;
  std::vector<ObjCorner> corners_;  ///< of the face being read
  bool is_complete_ = true;         ///< no index of the face being read points forward
  IndexKind vertex_indices_{"vertex", {}};
  IndexKind texture_indices_{"texture coordinate", {}};
  IndexKind normal_indices_{"normal", {}};
};

}  // namespace facemap
