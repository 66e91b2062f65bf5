#pragma once

#include <facemap/mesh.h>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "parallel/executor.h"
#include "scene/obj_chunk.h"

namespace facemap {

/// An OBJ text read in pieces by several threads: what ObjReader would read one line after the other, or nothing.
class ObjChunks {
 public:
  /// Texts shorter than this are not worth it.
  static constexpr std::size_t kLeastBytes = std::size_t{1} << 18;

  /// False if there is anything odd in the text (see ObjChunk): nothing is kept then. The text is not needed
  /// afterwards; parts of it that are done with are told to `release`, by several threads.
  using Release = std::function<void(std::string_view)>;
  bool read(std::string_view text, const Executor& executor, const Release& release = {});

  std::size_t triangle_count() const { return end_.triangle; }
  std::int64_t polygon_count() const { return end_.polygon; }

  /// Moves all arrays into an empty mesh. Polygons stand there as fans.
  void move_to(Mesh& mesh, const Executor& executor);

  /// Calls in the order of the file, after move_to: `cut` for polygons whose fan may be wrong, by their first triangle,
  /// number of corners and line; `read` for statements that are not read yet, by their text, their line and the first
  /// triangle after them.
  using Cut = std::function<void(std::size_t, std::size_t, std::int64_t)>;
  using Read = std::function<void(const char*, std::int64_t, std::size_t)>;
  void visit(const Mesh& mesh, const Executor& executor, const Cut& cut, const Read& read);

 private:
  /// What stands before a chunk.
  struct Start {
    ObjCounts counts;
    std::int64_t line = 1;
    std::size_t triangle = 0;
    std::int64_t polygon = 0;
  };

  bool read_again(const std::vector<std::string_view>& texts, const std::vector<std::size_t>& again,
                  const Executor& executor);
  bool find_starts();
  void fill_polygons(std::vector<std::uint32_t>& polygons) const;

  std::vector<ObjChunk> chunks_;
  std::vector<Start> starts_;  ///< of each
  Start end_;
};

}  // namespace facemap
