#include "bindings.h"
#include "pickling.h"

PYBIND11_MODULE(_facemap, module) {
  using namespace facemap::python;
  module.doc() = "The library behind the package facemap. Not to be used directly: it may change.";
  module.attr("__version__") = FACEMAP_VERSION;
  translate_errors();
  bind_lights(module);
  bind_scenes(module);
  bind_generated(module);
  bind_cameras(module);
  bind_pictures(module);
  bind_image_files(module);
  bind_views(module);
  complete_pickling(module);
}
