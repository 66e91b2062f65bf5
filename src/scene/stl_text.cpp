#include <facemap/error.h>

#include <algorithm>
#include <limits>

#include "scene/number.h"
#include "scene/obj_lines.h"
#include "scene/stl_mesh.h"
#include "scene/text_lines.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;

class StlText {
 public:
  StlText(std::string_view text, const std::string& name, const ModelLimits& limits, StlMesh& mesh, Model& model,
          ObjWarnings& warnings)
      : lines_(text),
        name_(name),
        most_facets_(std::min(limits.max_faces, StlMesh::kMostFacets)),
        mesh_(mesh),
        model_(model),
        warnings_(warnings) {}

  void read() {
    while (go_to_word()) read_statement();
    if (in_facet_) fail(Cause::TruncatedStatement, "the file ends in a facet");
  }

 private:
  /// Goes to the next word, in whichever line; false at the end of the text.
  bool go_to_word() {
    at_ = skip_blanks(at_);
    while (*at_ == '\n') {
      if (!lines_.next()) return false;
      at_ = skip_blanks(lines_.begin());
    }
    return true;
  }

  std::string_view word() const { return {at_, static_cast<std::size_t>(skip_token(at_) - at_)}; }

  /// Takes the word if it is this keyword, in lower or upper case.
  bool take(std::string_view keyword) {
    const std::string_view here = word();
    const bool is_same = here.size() == keyword.size() &&
                         std::equal(keyword.begin(), keyword.end(), here.begin(),
                                    [](char lower, char c) { return lower == c || (c >= 'A' && lower == (c | 0x20)); });
    if (is_same) at_ += here.size();
    return is_same;
  }

  void read_statement() {
    if (take("vertex")) return read_vertex();
    if (take("outer") || take("loop") || take("endloop")) return;
    if (take("endfacet")) return end_facet();
    if (take("facet")) return begin_facet();
    if (take("solid")) return begin_solid();
    if (!take("endsolid")) warnings_.add(lines_.number(), "unknown statement, ignored", word());
    skip_line();
  }

  void begin_solid() {
    if (in_facet_) fail(Cause::TruncatedStatement, "a solid begins in a facet");
    model_.objects.emplace_back(rest_of_line(at_));
    skip_line();
  }

  void begin_facet() {
    if (in_facet_) fail(Cause::TruncatedStatement, "a facet begins in a facet");
    if (mesh_.facet_count() == most_facets_) {
      fail(Cause::TooLarge, "more than " + std::to_string(most_facets_) + " triangles");
    }
    in_facet_ = true;
    corner_count_ = 0;
    normal_ = Vector(0);
    if (!go_to_word() || !take("normal")) return;
    for (int i = 0; i < 3; ++i) normal_[i] = read_number(true);
  }

  void read_vertex() {
    if (!in_facet_) fail(Cause::TruncatedStatement, "a vertex outside of any facet");
    if (corner_count_ == 3) fail(Cause::TruncatedStatement, "a facet of more than 3 vertices");
    Vector& corner = corners_[corner_count_++];
    for (int i = 0; i < 3; ++i) corner[i] = read_number(false);
  }

  void end_facet() {
    if (!in_facet_ || corner_count_ != 3) {
      fail(Cause::TruncatedStatement, "a facet of " + std::to_string(corner_count_) + " vertices");
    }
    in_facet_ = false;
    mesh_.add(corners_, normal_);
    if (model_.objects.empty()) model_.objects.emplace_back();
    model_.triangle_objects.push_back(static_cast<std::uint32_t>(model_.objects.size() - 1));
  }

  float read_number(bool may_be_not_finite) {
    if (!go_to_word()) fail(Cause::TruncatedStatement, "a number is missing");
    float value;
    const char* const end = scan_float(at_, value);
    if (end != nullptr) {
      at_ = end;
      return value;
    }
    if (!may_be_not_finite || !spells_not_finite(word())) {
      fail(Cause::BadNumber, "not a number that a float can hold: \"" + printable(word()) + "\"");
    }
    at_ = skip_token(at_);
    return std::numeric_limits<float>::quiet_NaN();
  }

  void skip_line() {
    while (*at_ != '\n') ++at_;
  }

  [[noreturn]] void fail(Cause cause, const std::string& reason) const {
    throw LoadError(cause, name_, lines_.number(), reason);
  }

  TextLines lines_;
  const char* at_ = "\n";
  const std::string& name_;
  std::uint64_t most_facets_;
  StlMesh& mesh_;
  Model& model_;
  ObjWarnings& warnings_;
  bool in_facet_ = false;
  int corner_count_ = 0;
  Vector corners_[3];
  Vector normal_{0};
};

}  // namespace

void read_stl_text(std::string_view text, const std::string& name, const ModelLimits& limits, StlMesh& mesh,
                   Model& model, ObjWarnings& warnings) {
  StlText(text, name, limits, mesh, model, warnings).read();
}

}  // namespace facemap
