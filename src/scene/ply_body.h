#pragma once

#include <facemap/error.h>
#include <facemap/mesh.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "scene/obj_warnings.h"
#include "scene/ply_header.h"

namespace facemap {

/// Where the values of a scalar property go: row i's to first[i * stride], rounded once to float.
struct PlyColumn {
  std::size_t property;
  float* first;
  std::size_t stride;  ///< in floats
};

/// What is wanted of an element whose rows hold indices, one a property, and a row's values of these.
struct PlyFaceRow {
  enum class Use : std::uint8_t { Skip, Indices, TextureCoordinates, TextureNumber, Red, Green, Blue };

  std::vector<Use> uses;
  std::vector<std::int64_t> indices;
  std::vector<float> texture_coordinates;
  std::int64_t texture_number = 0;
  std::array<float, 3> colour{};
};

/// What follows the head of a PLY file: rows of elements, read one after the other. Throws LoadError.
class PlyBody {
 public:
  virtual ~PlyBody() = default;

  /// How many rows there may be at most in what is left, each with a byte or a value at least for each property.
  virtual std::uint64_t most_rows(const PlyElement& element) const = 0;

  /// Reads `count` rows from `first` on. `columns` are in order of their properties; the others are read over.
  virtual void read_columns(const PlyElement& element, std::span<const PlyColumn> columns, std::uint64_t first,
                            std::uint64_t count) = 0;

  virtual void read_face(const PlyElement& element, std::uint64_t number, PlyFaceRow& row) = 0;

  /// Reads as many rows from here on as are quickly known to be triangles, of vertices 0..vertex_count-1, and nothing
  /// else that is wanted; at most `most`. Appends them to `triangles` and returns how many there are: the next row is
  /// for read_face.
  virtual std::uint64_t read_triangles(const PlyElement& element, const PlyFaceRow& row, std::uint64_t vertex_count,
                                       std::uint64_t most, std::vector<Corners>& triangles) = 0;

  /// Reads over all rows of an element.
  virtual void skip(const PlyElement& element) = 0;

  /// Refuses row `number` of an element, which read_face has read, or read_columns as the last.
  [[noreturn]] virtual void fail(LoadError::Cause cause, const PlyElement& element, std::uint64_t number,
                                 const std::string& reason) const = 0;

  /// Refuses what no row is to blame for.
  [[noreturn]] virtual void fail_whole(LoadError::Cause cause, const std::string& reason) const = 0;

  /// The line of the last row, or 0 if the body is binary: for warnings.
  virtual std::int64_t line() const = 0;

  /// How many rows read_columns is best asked for at a time: of a text one, so that `fail` knows the line.
  virtual std::uint64_t rows_at_once() const = 0;
};

/// A body of text: one row a line; blank lines are read over. `name` and `warnings` must outlive it.
std::unique_ptr<PlyBody> make_ply_text(std::string_view body, std::int64_t first_line, const std::string& name,
                                       ObjWarnings& warnings);

/// A binary body.
std::unique_ptr<PlyBody> make_ply_binary(std::string_view body, bool is_big_endian, const std::string& name);

/// "the file ends after 17 of 24 vertices"
std::string too_short(const PlyElement& element, std::uint64_t rows);

}  // namespace facemap
