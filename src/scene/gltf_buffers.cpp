#include "scene/gltf_buffers.h"

#include <filesystem>
#include <utility>

#include "scene/obj_lines.h"
#include "scene/uri.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;

std::string of_bytes(std::uint64_t wanted, std::uint64_t there) {
  return std::to_string(wanted) + " bytes, of which " + std::to_string(there) + " are there";
}

}  // namespace

GltfBytes GltfBuffers::view(std::uint32_t index, const GltfValue& named_by) {
  const GltfValue value = file_.root.element("bufferViews", index, named_by);
  const std::string_view bytes = buffer(value.at("buffer").as_index(), value);
  value.at("byteLength");
  const std::uint64_t offset = value.integer("byteOffset", 0), size = value.integer("byteLength", 0);
  if (offset > bytes.size() || size > bytes.size() - offset) {
    value.fail(Cause::TruncatedStatement, "ends " + std::to_string(offset) + " + " + std::to_string(size) +
                                              " bytes into a buffer of " + std::to_string(bytes.size()));
  }
  return {bytes.substr(offset, size), value.integer("byteStride", 0)};
}

std::string_view GltfBuffers::buffer(std::uint32_t index, const GltfValue& named_by) {
  const auto known = buffers_.find(index);
  if (known != buffers_.end()) return known->second.bytes;
  const GltfValue value = file_.root.element("buffers", index, named_by);
  value.at("byteLength");
  const std::uint64_t size = value.integer("byteLength", 0);
  Buffer& buffer = buffers_[index];  // does not move any more: short texts lie within it
  fill(buffer, index, value);
  if (size > buffer.bytes.size()) value.fail(Cause::TruncatedStatement, of_bytes(size, buffer.bytes.size()));
  buffer.bytes = buffer.bytes.substr(0, size);
  return buffer.bytes;
}

void GltfBuffers::fill(Buffer& buffer, std::uint32_t index, const GltfValue& value) {
  const std::optional<GltfValue> uri = value.find("uri");
  if (!uri) {
    if (index != 0 || !file_.binary) value.fail(Cause::BadValue, "has no \"uri\", and the file has no bytes for it");
    buffer.bytes = *file_.binary;
    return;
  }
  const std::string text = uri->as_text();
  if (!is_data_uri(text)) return read_file(buffer, *uri);
  UriResult<std::string> decoded = decode_data_uri(text);
  if (!decoded.value) uri->fail(Cause::BadEncoding, decoded.reason);
  buffer.decoded = *std::move(decoded.value);
  buffer.bytes = buffer.decoded;
}

void GltfBuffers::read_file(Buffer& buffer, const GltfValue& uri) {
  const UriResult<std::filesystem::path> found = find_file(file_.directory, uri.as_text(), file_.limits.allow_outside);
  const std::string shown = "\"" + printable(uri.as_text()) + "\"";
  if (!found.value) uri.fail(found.leads_out ? Cause::NotAllowed : Cause::CannotOpen, shown + ": " + found.reason);
  const std::uint64_t left = file_.limits.max_bytes - total_;
  try {
    buffer.file = std::make_unique<FileMapping>(*found.value, left);
  } catch (const LoadError& error) {
    uri.fail(error.cause(), shown + ": " + error.reason());
  }
  buffer.bytes = buffer.file->text();
  total_ += buffer.bytes.size();
}

}  // namespace facemap
