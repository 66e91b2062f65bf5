#include <algorithm>
#include <bit>
#include <cstring>
#include <optional>
#include <type_traits>

#include "scene/ply_body.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;

static_assert(std::endian::native == std::endian::little);

template <class Value>
Value load(const char* at, bool swap) {
  std::array<char, sizeof(Value)> bytes;
  std::memcpy(bytes.data(), at, sizeof(Value));
  if (swap) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<Value>(bytes);
}

/// Calls visit(Value()) for the type that a property's values have.
template <class Visit>
void with_type(PlyType type, const Visit& visit) {
  switch (type) {
    case PlyType::Int8:
      return visit(std::int8_t());
    case PlyType::UInt8:
      return visit(std::uint8_t());
    case PlyType::Int16:
      return visit(std::int16_t());
    case PlyType::UInt16:
      return visit(std::uint16_t());
    case PlyType::Int32:
      return visit(std::int32_t());
    case PlyType::UInt32:
      return visit(std::uint32_t());
    case PlyType::Float32:
      return visit(float());
    case PlyType::Float64:
      return visit(double());
  }
}

/// Values `step` bytes from each other, to floats `stride` from each other.
void convert(PlyType type, bool swap, const char* at, std::size_t step, std::size_t count, float* to,
             std::size_t stride) {
  with_type(type, [&](auto kind) {
    using Value = decltype(kind);
    const auto copy = [&](auto is_swapped) {
      for (std::size_t i = 0; i != count; ++i) {
        to[i * stride] = static_cast<float>(load<Value>(at + i * step, is_swapped.value));
      }
    };
    swap ? copy(std::true_type()) : copy(std::false_type());
  });
}

/// Rounds to an integer; what is none (NaN) or too large becomes -1, which no index and no count is.
template <class Value>
std::int64_t whole(Value value) {
  if constexpr (std::is_floating_point_v<Value>) {
    return value >= 0 && value <= Value(0x1p31) ? static_cast<std::int64_t>(value) : -1;
  } else {
    return value;
  }
}

class PlyBinary final : public PlyBody {
 public:
  PlyBinary(std::string_view body, bool is_big_endian, const std::string& name)
      : at_(body.data()), end_(body.data() + body.size()), swap_(is_big_endian), name_(name) {}

  std::uint64_t most_rows(const PlyElement& element) const override {
    return bytes_left() / std::max<std::size_t>(1, element.least_row_size());
  }

  void read_columns(const PlyElement& element, std::span<const PlyColumn> columns, std::uint64_t first,
                    std::uint64_t count) override {
    if (!element.has_lists()) return read_fixed_columns(element, columns, first, count);
    for (std::uint64_t row = first; row != first + count; ++row) {
      const PlyColumn* column = columns.data();
      for (std::size_t i = 0; i != element.properties.size(); ++i) {
        const PlyProperty& property = element.properties[i];
        if (column != columns.data() + columns.size() && column->property == i) {
          const char* const value = take(size_of(property.type), element, row);
          convert(property.type, swap_, value, 0, 1, column->first + row * column->stride, 0);
          ++column;
        } else {
          skip_value(property, element, row);
        }
      }
    }
  }

  void read_face(const PlyElement& element, std::uint64_t number, PlyFaceRow& row) override {
    using Use = PlyFaceRow::Use;
    for (std::size_t i = 0; i != element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      switch (row.uses[i]) {
        case Use::Skip:
          skip_value(property, element, number);
          break;
        case Use::Indices: {
          std::size_t count;
          const char* const values = take_list(property, element, number, count);
          row.indices.resize(count);
          to_indices(property.type, values, row.indices);
          break;
        }
        case Use::TextureCoordinates: {
          std::size_t count;
          const char* const values = take_list(property, element, number, count);
          row.texture_coordinates.resize(count);
          convert(property.type, swap_, values, size_of(property.type), count, row.texture_coordinates.data(), 1);
          break;
        }
        case Use::TextureNumber:
          row.texture_number = take_whole(property.type, element, number);
          break;
        case Use::Red:
        case Use::Green:
        case Use::Blue: {
          const std::size_t channel = static_cast<std::size_t>(row.uses[i]) - static_cast<std::size_t>(Use::Red);
          convert(property.type, swap_, take(size_of(property.type), element, number), 0, 1, &row.colour[channel], 0);
          break;
        }
      }
    }
  }

  std::uint64_t read_triangles(const PlyElement& element, const PlyFaceRow& row, std::uint64_t vertex_count,
                               std::uint64_t most, std::vector<Corners>& triangles) override {
    const std::optional<TriangleRow> layout = triangle_row(element, row);
    if (!layout) return 0;
    const std::uint64_t rows = std::min<std::uint64_t>(most, bytes_left() / layout->size);
    return swap_ ? take_triangles<true>(*layout, rows, vertex_count, triangles)
                 : take_triangles<false>(*layout, rows, vertex_count, triangles);
  }

  void skip(const PlyElement& element) override {
    if (!element.has_lists()) {
      take_rows(element, 0, element.count);
      return;
    }
    for (std::uint64_t row = 0; row != element.count; ++row) {
      for (const PlyProperty& property : element.properties) skip_value(property, element, row);
    }
  }

  [[noreturn]] void fail(Cause cause, const PlyElement& element, std::uint64_t number,
                         const std::string& reason) const override {
    throw LoadError(cause, name_, 0, element.name + " " + std::to_string(number) + " (from 0): " + reason);
  }

  [[noreturn]] void fail_whole(Cause cause, const std::string& reason) const override {
    throw LoadError(cause, name_, 0, reason);
  }

  std::int64_t line() const override { return 0; }
  std::uint64_t rows_at_once() const override { return 2048; }  // that fit the processor's first cache

 private:
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }

  const char* take(std::size_t bytes, const PlyElement& element, std::uint64_t row) {
    if (bytes > bytes_left()) fail_whole(Cause::TruncatedStatement, too_short(element, row));
    const char* const begin = at_;
    at_ += bytes;
    return begin;
  }

  const char* take_rows(const PlyElement& element, std::uint64_t first, std::uint64_t count) {
    const std::size_t size = element.least_row_size();
    if (size != 0 && bytes_left() / size < count) {
      fail_whole(Cause::TruncatedStatement, too_short(element, first + bytes_left() / size));
    }
    const char* const begin = at_;
    at_ += size * count;
    return begin;
  }

  /// Where a triangle's indices stand in a row of the kind that nearly all files have: one list, its length in a byte,
  /// the indices in four, and nothing else that is wanted.
  struct TriangleRow {
    std::size_t list;  ///< bytes before it
    std::size_t size;  ///< of a row
  };

  static std::optional<TriangleRow> triangle_row(const PlyElement& element, const PlyFaceRow& row) {
    TriangleRow layout{0, 0};
    for (std::size_t i = 0; i != element.properties.size(); ++i) {
      const PlyProperty& property = element.properties[i];
      if (row.uses[i] == PlyFaceRow::Use::Indices) {
        if (size_of(property.count_type) != 1 || size_of(property.type) != 4) return std::nullopt;
        layout.list = layout.size;
        layout.size += 1 + 3 * 4;
      } else {
        if (property.is_list || row.uses[i] != PlyFaceRow::Use::Skip) return std::nullopt;
        layout.size += size_of(property.type);
      }
    }
    return layout;
  }

  template <bool swap>
  std::uint64_t take_triangles(const TriangleRow& layout, std::uint64_t rows, std::uint64_t vertex_count,
                               std::vector<Corners>& triangles) {
    std::uint64_t taken = 0;
    for (; taken != rows; ++taken) {
      const char* const list = at_ + layout.list;
      if (list[0] != 3) break;
      const Corners corners = {load<std::uint32_t>(list + 1, swap), load<std::uint32_t>(list + 5, swap),
                               load<std::uint32_t>(list + 9, swap)};
      // What is negative is above any count.
      if (corners[0] >= vertex_count || corners[1] >= vertex_count || corners[2] >= vertex_count) break;
      triangles.push_back(corners);
      at_ += layout.size;
    }
    return taken;
  }

  void read_fixed_columns(const PlyElement& element, std::span<const PlyColumn> columns, std::uint64_t first,
                          std::uint64_t count) {
    const std::size_t size = element.least_row_size();
    const char* value = take_rows(element, first, count);
    std::size_t property = 0;
    for (const PlyColumn& column : columns) {
      for (; property != column.property; ++property) value += size_of(element.properties[property].type);
      convert(element.properties[property].type, swap_, value, size, count, column.first + first * column.stride,
              column.stride);
    }
  }

  std::int64_t take_whole(PlyType type, const PlyElement& element, std::uint64_t row) {
    const char* const at = take(size_of(type), element, row);
    std::int64_t result = 0;
    with_type(type, [&](auto kind) { result = whole(load<decltype(kind)>(at, swap_)); });
    return result;
  }

  /// The values of a list, which are all there; `count` becomes its length.
  const char* take_list(const PlyProperty& property, const PlyElement& element, std::uint64_t row, std::size_t& count) {
    const std::int64_t length = take_whole(property.count_type, element, row);
    if (length < 0) fail(Cause::BadNumber, element, row, "a list of length " + std::to_string(length));
    count = static_cast<std::size_t>(length);  // below 2^32: no overflow in 64 bits
    return take(count * size_of(property.type), element, row);
  }

  void skip_value(const PlyProperty& property, const PlyElement& element, std::uint64_t row) {
    std::size_t count;
    if (property.is_list) {
      take_list(property, element, row, count);
    } else {
      take(size_of(property.type), element, row);
    }
  }

  void to_indices(PlyType type, const char* values, std::vector<std::int64_t>& indices) const {
    with_type(type, [&](auto kind) {
      using Value = decltype(kind);
      for (std::size_t i = 0; i != indices.size(); ++i) {
        indices[i] = whole(load<Value>(values + i * sizeof(Value), swap_));
      }
    });
  }

  const char* at_;
  const char* end_;
  bool swap_;
  const std::string& name_;
};

}  // namespace

std::unique_ptr<PlyBody> make_ply_binary(std::string_view body, bool is_big_endian, const std::string& name) {
  return std::make_unique<PlyBinary>(body, is_big_endian, name);
}

std::string too_short(const PlyElement& element, std::uint64_t rows) {
  return "the file ends after " + std::to_string(rows) + " of " + std::to_string(element.count) +
         " rows of element \"" + element.name + "\"";
}

}  // namespace facemap
