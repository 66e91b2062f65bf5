#include "scene/stl.h"

#include <facemap/error.h>

#include <algorithm>
#include <utility>

#include "scene/number.h"
#include "scene/obj_warnings.h"
#include "scene/stl_binary.h"
#include "scene/stl_mesh.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;

std::string_view without_byte_order_mark(std::string_view text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  return text;
}

}  // namespace

bool is_stl_binary_by_size(std::string_view bytes) {
  return bytes.size() >= kStlHeaderSize && (bytes.size() - kStlHeaderSize) % kStlFacetSize == 0 &&
         (bytes.size() - kStlHeaderSize) / kStlFacetSize == stl_facet_count(bytes);
}

bool is_stl_text(std::string_view bytes) {
  constexpr std::size_t kHead = 512;  // bytes: a binary file's count and first facets are in it
  if (is_stl_binary_by_size(bytes)) return false;
  std::string_view text = without_byte_order_mark(bytes.substr(0, kHead));
  text.remove_prefix(std::min(text.find_first_not_of(" \t\r\n"), text.size()));
  constexpr std::string_view kSolid = "solid";
  const bool is_solid =
      text.size() > kSolid.size() && ends_token(text[kSolid.size()]) &&
      std::equal(kSolid.begin(), kSolid.end(), text.begin(), [](char lower, char c) { return (c | 0x20) == lower; });
  return is_solid && text.find('\0') == std::string_view::npos;
}

Model read_stl(std::string_view bytes, const std::string& name, const ModelLimits& limits) {
  if (bytes.size() > limits.max_bytes) {
    throw LoadError(Cause::TooLarge, name, 0, "more than " + std::to_string(limits.max_bytes) + " bytes");
  }
  Model model;
  model.up = Vector(0, 0, 1);  // no file says so, and nearly all mean it
  ObjWarnings warnings(name);
  StlMesh mesh(model);
  if (is_stl_text(bytes)) {
    read_stl_text(without_byte_order_mark(bytes), name, limits, mesh, model, warnings);
  } else {
    read_stl_binary(bytes, name, limits, mesh, model, warnings);
  }
  if (mesh.facet_count() == 0) throw LoadError(Cause::NoFaces, name, 0, "no faces");
  mesh.finish(limits.threads, warnings);
  warnings.append_to(model.warnings);
  return model;
}

}  // namespace facemap
