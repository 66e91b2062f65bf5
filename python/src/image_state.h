#pragma once

#include <facemap/image.h>
#include <pybind11/pybind11.h>

#include <memory>

namespace facemap::python {

namespace py = pybind11;

// For pickle: a picture and its planes as bytes. What is no such state throws ValueError.
py::tuple state_of(const Image& image);
std::shared_ptr<Image> image_from(const py::tuple& state);

}  // namespace facemap::python
