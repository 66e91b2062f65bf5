#include <facemap/error.h>

#include "bindings.h"

namespace facemap::python {
namespace {

py::object class_named(const char* name) { return py::module_::import("facemap.errors").attr(name); }

void raise(const LoadError& error) {
  const py::object type = class_named(error.cause() == LoadError::Cause::CannotOpen ? "OpenError" : "LoadError");
  const py::object raised = type(error.what(), error.file(), error.line(), error.column(), error.reason());
  PyErr_SetObject(type.ptr(), raised.ptr());
}

}  // namespace

void translate_errors() {
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const LoadError& error) {
      raise(error);
    } catch (const Error& error) {
      PyErr_SetString(class_named("Error").ptr(), error.what());
    }
  });
}

}  // namespace facemap::python
