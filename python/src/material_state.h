#pragma once

#include <facemap/model.h>
#include <pybind11/pybind11.h>

#include <vector>

namespace facemap::python {

namespace py = pybind11;

// What a model has besides arrays, for pickle: tuples of texts and of bytes as they lie in memory. They are read by the
// version of the module that wrote them; others throw ValueError.
py::tuple states_of(const std::vector<Material>& materials);
py::tuple states_of(const std::vector<TextureImage>& images);
py::tuple states_of(const std::vector<ModelCamera>& cameras);
std::vector<Material> materials_from(const py::tuple& states);
std::vector<TextureImage> images_from(const py::tuple& states);
std::vector<ModelCamera> cameras_from(const py::tuple& states);

}  // namespace facemap::python
