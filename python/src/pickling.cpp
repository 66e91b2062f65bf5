#include "pickling.h"

#include <string>

namespace facemap::python {
namespace {

py::tuple reduced(const py::object& self) {
  const py::type type = py::type::of(self);
  if (py::hasattr(type, "__members__")) return py::make_tuple(type, py::make_tuple(py::int_(self)));
  throw py::type_error("cannot pickle '" + std::string(py::str(type.attr("__name__"))) + "' object");
}

}  // namespace

void complete_pickling(const py::object& holder) {
  for (const auto item : py::dict(holder.attr("__dict__"))) {
    if (PyType_Check(item.second.ptr()) == 0) continue;
    const auto found = py::reinterpret_borrow<py::object>(item.second);
    complete_pickling(found);
    if (found.attr("__dict__").contains("__reduce__")) continue;
    py::setattr(found, "__reduce__", py::cpp_function(&reduced, py::name("__reduce__"), py::is_method(found)));
  }
}

}  // namespace facemap::python
