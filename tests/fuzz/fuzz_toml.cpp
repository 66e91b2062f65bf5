// Any bytes are a scene file or are refused, with their place: nothing else may happen. What was read is written and
// reads back as the same text.

#include <facemap/error.h>
#include <facemap/scene_file.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

namespace {

facemap::SceneFile parse(std::string_view text) {
  facemap::ModelLimits limits;
  limits.allow_outside = true;  // no file is opened: paths are taken as they are
  return facemap::parse_scene_file(text, "fuzz.toml", "no/such/folder", limits);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  facemap::SceneFile scene;
  try {
    scene = parse(text);
  } catch (const facemap::LoadError& refused) {
    if (refused.line() < 0 || refused.reason().empty()) std::abort();
    return 0;
  }
  const std::string written = scene_file_text(scene, "no/such/folder");
  const facemap::SceneFile again = parse(written);
  if (scene_file_text(again, "no/such/folder") != written) std::abort();
  return 0;
}
