#include <limits>

#include "scene/number.h"
#include "scene/obj_lines.h"
#include "scene/ply_body.h"
#include "scene/text_lines.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;

std::string_view token_at(const char* at) { return {at, static_cast<std::size_t>(skip_token(at) - at)}; }

class PlyText final : public PlyBody {
 public:
  PlyText(std::string_view body, std::int64_t first_line, const std::string& name, ObjWarnings& warnings)
      : lines_(body, first_line), name_(name), warnings_(warnings) {}

  std::uint64_t most_rows(const PlyElement& element) const override {
    const std::size_t values = element.properties.empty() ? 1 : element.properties.size();
    return (lines_.bytes_left() + 1) / (2 * values);  // a digit and a blank each; the last line may lack its end
  }

  void read_columns(const PlyElement& element, std::span<const PlyColumn> columns, std::uint64_t first,
                    std::uint64_t count) override {
    for (std::uint64_t row = first; row != first + count; ++row) {
      begin_row(element, row);
      std::size_t property = 0;
      for (const PlyColumn& column : columns) {
        for (; property != column.property; ++property) skip_value(element.properties[property]);
        column.first[row * column.stride] = read_float();
        ++property;
      }
      for (; property != element.properties.size(); ++property) skip_value(element.properties[property]);
      end_row();
    }
  }

  void read_face(const PlyElement& element, std::uint64_t number, PlyFaceRow& row) override {
    using Use = PlyFaceRow::Use;
    begin_row(element, number);
    for (std::size_t i = 0; i != element.properties.size(); ++i) {
      switch (row.uses[i]) {
        case Use::Skip:
          skip_value(element.properties[i]);
          break;
        case Use::Indices:
          row.indices.clear();
          for (std::int64_t left = read_count(); left > 0; --left) row.indices.push_back(read_whole());
          break;
        case Use::TextureCoordinates:
          row.texture_coordinates.clear();
          for (std::int64_t left = read_count(); left > 0; --left) row.texture_coordinates.push_back(read_float());
          break;
        case Use::TextureNumber:
          row.texture_number = read_whole();
          break;
        case Use::Red:
        case Use::Green:
        case Use::Blue:
          row.colour[static_cast<std::size_t>(row.uses[i]) - static_cast<std::size_t>(Use::Red)] = read_float();
          break;
      }
    }
    end_row();
  }

  std::uint64_t read_triangles(const PlyElement&, const PlyFaceRow&, std::uint64_t, std::uint64_t,
                               std::vector<Corners>&) override {
    return 0;  // reading numbers takes longer than all the rest
  }

  void skip(const PlyElement& element) override {
    if (element.properties.empty()) return;
    for (std::uint64_t row = 0; row != element.count; ++row) begin_row(element, row);
  }

  [[noreturn]] void fail(Cause cause, const PlyElement&, std::uint64_t, const std::string& reason) const override {
    fail_whole(cause, reason);
  }

  [[noreturn]] void fail_whole(Cause cause, const std::string& reason) const override {
    throw LoadError(cause, name_, lines_.number(), reason);
  }

  std::int64_t line() const override { return lines_.number(); }
  std::uint64_t rows_at_once() const override { return 1; }

 private:
  void begin_row(const PlyElement& element, std::uint64_t row) {
    do {
      if (!lines_.next()) fail_whole(Cause::TruncatedStatement, too_short(element, row));
      at_ = skip_blanks(lines_.begin());
    } while (*at_ == '\n');
  }

  void end_row() {
    if (*skip_blanks(at_) != '\n') {
      warnings_.add(lines_.number(), "more values than the header says, ignored");
    }
  }

  float read_float() {
    at_ = skip_blanks(at_);
    float value;
    const char* const end = scan_float(at_, value);
    if (end == nullptr) {
      if (!spells_not_finite(token_at(at_))) fail_number();
      at_ = skip_token(at_);
      return std::numeric_limits<float>::quiet_NaN();
    }
    at_ = end;
    return value;
  }

  std::int64_t read_whole() {
    at_ = skip_blanks(at_);
    std::int64_t value;
    const char* const end = scan_index(at_, value);
    if (end == nullptr || !ends_token(*end)) fail_number();
    at_ = end;
    return value;
  }

  std::int64_t read_count() {
    const char* const token = skip_blanks(at_);
    const std::int64_t count = read_whole();
    if (count < 0) fail_whole(Cause::BadNumber, "a list of length " + printable(token_at(token)));
    return count;
  }

  void skip_value(const PlyProperty& property) {
    for (std::int64_t left = property.is_list ? read_count() : 1; left > 0; --left) {
      at_ = skip_blanks(at_);
      if (*at_ == '\n') fail_number();
      at_ = skip_token(at_);
    }
  }

  [[noreturn]] void fail_number() const {
    if (*at_ == '\n') fail_whole(Cause::TruncatedStatement, "a value is missing");
    fail_whole(Cause::BadNumber, "not a number of the kind wanted here: \"" + printable(token_at(at_)) + "\"");
  }

  TextLines lines_;
  const char* at_ = nullptr;
  const std::string& name_;
  ObjWarnings& warnings_;
};

}  // namespace

std::unique_ptr<PlyBody> make_ply_text(std::string_view body, std::int64_t first_line, const std::string& name,
                                       ObjWarnings& warnings) {
  return std::make_unique<PlyText>(body, first_line, name, warnings);
}

}  // namespace facemap
