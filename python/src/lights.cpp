#include <facemap/light.h>
#include <facemap/model.h>
#include <pybind11/stl.h>

#include "arrays.h"
#include "bindings.h"

namespace facemap::python {
namespace {

template <typename Class>
auto vector_property(Vector Class::*field) {
  return std::pair([field](const Class& object) { return triple_of(object.*field); },
                   [field](Class& object, const Triple& value) { object.*field = vector_of(value); });
}

template <typename Class, typename Bound>
void add_vector(Bound& bound, const char* name, Vector Class::*field) {
  const auto [get, set] = vector_property(field);
  bound.def_property(name, get, set);
}

}  // namespace

void bind_lights(py::module_& module) {
  py::class_<Light> light(module, "Light");
  py::enum_<Light::Kind>(light, "Kind")
      .value("point", Light::Kind::Point)
      .value("spot", Light::Kind::Spot)
      .value("directional", Light::Kind::Directional);
  light.def(py::init())
      .def_readwrite("kind", &Light::kind)
      .def_readwrite("intensity", &Light::intensity)
      .def_readwrite("inner_angle", &Light::inner_angle)
      .def_readwrite("outer_angle", &Light::outer_angle)
      .def_readwrite("has_falloff", &Light::has_falloff)
      .def_readwrite("range", &Light::range)
      .def_property(
          "color", [](const Light& l) { return triple_of(l.color); },
          [](Light& l, const Triple& value) { l.color = color_of(value); });
  add_vector(light, "position", &Light::position);
  add_vector(light, "direction", &Light::direction);

  py::class_<ModelCamera> camera(module, "ModelCamera");
  camera.def_readonly("name", &ModelCamera::name)
      .def_readonly("is_parallel", &ModelCamera::is_parallel)
      .def_readonly("field_angle", &ModelCamera::field_angle)
      .def_readonly("height", &ModelCamera::height);
  camera.def_property_readonly("position", [](const ModelCamera& c) { return triple_of(c.position); })
      .def_property_readonly("look_at", [](const ModelCamera& c) { return triple_of(c.look_at); })
      .def_property_readonly("up", [](const ModelCamera& c) { return triple_of(c.up); });
}

}  // namespace facemap::python
