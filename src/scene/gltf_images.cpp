#include "scene/gltf_images.h"

#include <string>

#include "scene/obj_lines.h"
#include "scene/uri.h"

namespace facemap {

namespace {

using Cause = LoadError::Cause;

constexpr std::string_view kTransform = "KHR_texture_transform";

/// WebGL's numbers.
constexpr std::uint64_t kRepeat = 10497, kClampToEdge = 33071, kMirroredRepeat = 33648, kNearest = 9728;

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); }
bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xFF\xD8\xFF"); }

TextureUse::Wrap wrap_of(const GltfValue& sampler, std::string_view key) {
  const std::uint64_t value = sampler.integer(key, kRepeat);
  if (value == kClampToEdge) return TextureUse::Wrap::Clamp;
  if (value == kMirroredRepeat) return TextureUse::Wrap::Mirror;
  if (value != kRepeat) sampler.at(key).fail(Cause::BadValue, "is not a way to wrap");
  return TextureUse::Wrap::Repeat;
}

void read_transform(const GltfValue& transform, TextureUse& use) {
  const auto offset = transform.numbers<2>("offset", {0, 0}), scale = transform.numbers<2>("scale", {1, 1});
  use.offset = {static_cast<float>(offset[0]), static_cast<float>(offset[1])};
  use.scale = {static_cast<float>(scale[0]), static_cast<float>(scale[1])};
  // Counter-clockwise in a space whose v is down: from u away from v. (The extension's GLSL lines say the opposite, but
  // not its text, its examples, its test model and those who read it: Khronos glTF issue 1563.)
  use.rotation = -static_cast<float>(transform.number("rotation", 0));
}

}  // namespace

std::uint32_t GltfImages::coordinate_set(const GltfValue& info) {
  const std::optional<GltfValue> transform = info.extension(kTransform);
  if (transform && transform->find("texCoord")) return *transform->index("texCoord");
  return info.index("texCoord").value_or(0);
}

TextureUse GltfImages::texture(const GltfValue& info) {
  TextureUse use;
  use.is_v_down = true;
  const GltfValue index = info.at("index");
  const GltfValue texture = file_.root.element("textures", index.as_index(), index);
  if (const auto sampler_index = texture.find("sampler")) {
    const GltfValue sampler = file_.root.element("samplers", sampler_index->as_index(), *sampler_index);
    use.wrap_u = wrap_of(sampler, "wrapS");
    use.wrap_v = wrap_of(sampler, "wrapT");
    use.is_smooth = sampler.integer("magFilter", 0) != kNearest;
  }
  if (const auto transform = info.extension(kTransform)) read_transform(*transform, use);
  if (const auto source = texture.find("source")) {
    use.image = image(source->as_index(), *source);
  } else {
    file_.warn(texture, "a texture without a PNG or JPEG image is left out");
  }
  return use;
}

std::uint32_t GltfImages::image(std::uint32_t index, const GltfValue& named_by) {
  const auto known = places_.find(index);
  if (known != places_.end()) return known->second;
  const GltfValue value = file_.root.element("images", index, named_by);
  TextureImage image;
  const bool is_there = read_image(value, image);
  const std::uint32_t place = is_there ? static_cast<std::uint32_t>(images_.size()) : kNoIndex;
  if (is_there) images_.push_back(std::move(image));
  return places_[index] = place;
}

bool GltfImages::read_image(const GltfValue& value, TextureImage& image) {
  image.name = value.text("name", value.path());
  const std::optional<GltfValue> uri = value.find("uri");
  if (!uri) {
    const GltfValue view = value.at("bufferView");
    return keep_bytes(value, buffers_.view(view.as_index(), view).bytes, image);
  }
  const std::string text = uri->as_text();
  if (!is_data_uri(text)) return find_file(*uri, image);
  const UriResult<std::string> decoded = decode_data_uri(text);
  if (decoded.value) return keep_bytes(value, *decoded.value, image);
  file_.warn(value, "an image that cannot be read is left out");
  return false;
}

bool GltfImages::find_file(const GltfValue& uri, TextureImage& image) {
  image.name = uri.as_text();
  const UriResult<std::filesystem::path> found =
      facemap::find_file(file_.directory, image.name, file_.limits.allow_outside);
  if (found.value) {
    image.file = *found.value;
  } else if (found.leads_out) {
    file_.warnings.add(0, "a texture outside the model's folder is left out", image.name);
  } else {
    file_.warnings.add(0, "texture not found", image.name);
  }
  return found.value.has_value();
}

bool GltfImages::keep_bytes(const GltfValue& value, std::string_view bytes, TextureImage& image) {
  if (!is_png(bytes) && !is_jpeg(bytes)) {
    file_.warn(value, "an image that is neither PNG nor JPEG is left out");
    return false;
  }
  kept_bytes_ += bytes.size();
  // Images that share bytes would take any amount of memory by a short text for each.
  if (kept_bytes_ > buffers_.total_bytes()) value.fail(Cause::TooLarge, "images have more bytes than the file");
  image.bytes.assign(bytes.begin(), bytes.end());
  return true;
}

}  // namespace facemap
