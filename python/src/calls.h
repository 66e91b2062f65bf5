#pragma once

#include <pybind11/pybind11.h>

#include <functional>

namespace facemap::python {

namespace py = pybind11;

/// What a long call tells of itself: the fraction done (0..1) and the phase. False: it is to stop.
using Report = std::function<bool(double, const char*)>;

/// Does work of the library without the interpreter's lock, so that other Python threads go on. Short work is done at
/// once.
void call(const std::function<void()>& work);

/// Long work is done by a thread of its own, while the caller's looks for signals and tells `progress` (None or a
/// callable of fraction and phase): Python handles signals in its main thread alone. What a handler or `progress`
/// raises, such as KeyboardInterrupt, stops the work as soon as it reports, and is passed on.
void call_interruptibly(const std::function<void(const Report&)>& work, const py::object& progress = py::none());

}  // namespace facemap::python
