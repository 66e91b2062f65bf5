#include <facemap/generators.h>
#include <facemap/model.h>
#include <facemap/scene.h>
#include <pybind11/stl.h>

#include <memory>
#include <sstream>

#include "arrays.h"
#include "bindings.h"
#include "calls.h"

namespace facemap::python {
namespace {

/// The scene as its OBJ file has it, smoothing groups included, and its view and lights.
py::tuple generate(const std::string& name, int detail) {
  GeneratedScene made;
  std::shared_ptr<Scene> scene;
  call_interruptibly([&](const Report&) {
    made = generate_scene(name, detail);
    std::ostringstream text;
    write_obj(text, made, name + ".obj");
    scene = std::make_shared<Scene>(parse_model(text.str(), name + ".obj"));
  });
  py::list lights;
  for (const GeneratedScene::Light& light : made.lights) {
    lights.append(py::make_tuple(triple_of(light.position), triple_of(light.color * light.intensity)));
  }
  const py::tuple camera = py::make_tuple(triple_of(made.camera_position), triple_of(made.look_at), triple_of(made.up),
                                          double{made.field_angle_deg});
  return py::make_tuple(scene, camera, lights);
}

}  // namespace

void bind_generated(py::module_& module) {
  module.def("generate", &generate, py::arg("name"), py::arg("detail"));
  module.def("generator_names", &generator_names);
  module.attr("most_detail") = kMaxSceneDetail;
}

}  // namespace facemap::python
