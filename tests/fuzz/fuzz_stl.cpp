// Any bytes are a STL file or are refused: nothing else may happen. What was read must make a scene.

#include <facemap/error.h>
#include <facemap/scene.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "scene/stl.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace facemap;
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ModelLimits limits;
  limits.max_faces = 1 << 16;
  try {
    Model model = read_stl(bytes, "fuzz.stl", limits);
    const std::size_t count = model.mesh.face_count();
    if (count > limits.max_faces || count == 0) std::abort();
    if (!model.triangle_objects.empty() && model.triangle_objects.size() != count) std::abort();
    for (const std::uint32_t object : model.triangle_objects) {
      if (object >= model.objects.size()) std::abort();
    }
    const Scene scene(std::move(model.mesh), std::move(model.materials));  // throws Error if an index is wrong
    if (scene.face_count() != count) std::abort();
  } catch (const LoadError& refused) {
    if (refused.line() < 0 || refused.reason().empty()) std::abort();
  } catch (const Error&) {
    std::abort();
  }
  return 0;
}
