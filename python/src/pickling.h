#pragma once

#include <pybind11/pybind11.h>

#include <algorithm>
#include <string_view>
#include <type_traits>
#include <vector>

namespace facemap::python {

namespace py = pybind11;

/// Numbers as they lie in memory, so that they come back as they are.
template <typename Row>
py::bytes bytes_of(const std::vector<Row>& rows) {
  static_assert(std::is_trivially_copyable_v<Row>);
  return {reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(Row)};
}

/// Throws ValueError if they are not whole rows.
template <typename Row>
std::vector<Row> rows_from(const py::handle& bytes) {
  static_assert(std::is_trivially_copyable_v<Row>);
  const auto text = bytes.cast<std::string_view>();
  if (text.size() % sizeof(Row) != 0) throw py::value_error("a state has lost bytes");
  std::vector<Row> rows(text.size() / sizeof(Row));
  std::copy(text.begin(), text.end(), reinterpret_cast<char*>(rows.data()));
  return rows;
}

/// Lets objects of the class be pickled and copied: `state_of` makes a tuple of one, and the class, called with it,
/// makes the object again by `from_state`. Not by py::pickle, which protocols 0 and 1 of pickle go past, into a
/// constructor of pybind11's own that ends the process.
template <typename Class, typename Bound, typename StateOf, typename FromState>
void add_pickling(Bound& bound, const StateOf& state_of, const FromState& from_state) {
  bound.def(py::init(from_state), py::arg("state"));
  bound.def("__reduce__", [state_of](const py::object& self) {
    return py::make_tuple(py::type::of(self), py::make_tuple(state_of(self.cast<const Class&>())));
  });
}

/// Gives the other classes that `holder` holds, a module or a class, a __reduce__ too, lest they end the process:
/// enumerations become their numbers, and the rest is refused with TypeError.
void complete_pickling(const py::object& holder);

}  // namespace facemap::python
