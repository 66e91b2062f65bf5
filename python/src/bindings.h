#pragma once

#include <pybind11/pybind11.h>

namespace facemap::python {

namespace py = pybind11;

/// Errors of the library become the classes of facemap/errors.py.
void translate_errors();

// What the module holds, a file each. The package's Python part checks arguments and names them in its errors.
void bind_lights(py::module_& module);
void bind_scenes(py::module_& module);
void bind_generated(py::module_& module);
void bind_cameras(py::module_& module);
void bind_pictures(py::module_& module);
void bind_image_files(py::module_& module);
void bind_views(py::module_& module);

}  // namespace facemap::python
