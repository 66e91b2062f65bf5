#pragma once

#include <facemap/error.h>
#include <facemap/scene.h>

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace facemap {

/// Ends the process if a model is not one that a Scene can take, or has more than the limits allow.
inline void check_model(Model model, const ModelLimits& limits) {
  const std::size_t count = model.mesh.face_count();
  if (count > limits.max_faces || count == 0) std::abort();
  if (!model.triangle_objects.empty() && model.triangle_objects.size() != count) std::abort();
  for (const std::uint32_t object : model.triangle_objects) {
    if (object >= model.objects.size()) std::abort();
  }
  const Scene scene(std::move(model.mesh), std::move(model.materials));  // throws Error if an index is wrong
  if (scene.face_count() != count) std::abort();
}

/// Gives the bytes to read(bytes, limits), a reader of models: it must give a whole model or refuse them with a reason.
template <class Read>
int fuzz_model(const std::uint8_t* data, std::size_t size, const Read& read) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  ModelLimits limits;
  limits.max_faces = 1 << 16;
  try {
    check_model(read(bytes, limits), limits);
  } catch (const LoadError& refused) {
    if (refused.line() < 0 || refused.reason().empty()) std::abort();
  } catch (const Error&) {
    std::abort();
  }
  return 0;
}

}  // namespace facemap
