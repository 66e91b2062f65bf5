// Any bytes are a STL file or are refused: nothing else may happen. What was read must make a scene.

#include "fuzz/fuzz_model.h"
#include "scene/stl.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return facemap::fuzz_model(data, size, [](std::string_view bytes, const facemap::ModelLimits& limits) {
    return facemap::read_stl(bytes, "fuzz.stl", limits);
  });
}
