// Any bytes are an OBJ file or are refused: nothing else may happen. What was read must make a scene.

#include <facemap/error.h>
#include <facemap/obj.h>
#include <facemap/scene.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace facemap;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  OBJ::Limits limits;
  limits.max_faces = 1 << 16;
  try {
    OBJ obj = OBJ::parse(text, "fuzz.obj", "", limits);
    const OBJ::Report report = obj.report();
    if (static_cast<std::uint64_t>(report.triangles) > limits.max_faces || report.triangles == 0) std::abort();
    const Scene scene(std::move(obj).mesh());  // throws Error if an index or a position is wrong
    if (scene.face_count() != static_cast<std::size_t>(report.triangles)) std::abort();
  } catch (const LoadError& refused) {
    if (refused.line() < 0 || refused.reason().empty()) std::abort();
  } catch (const Error&) {
    std::abort();
  }
  return 0;
}
