#pragma once

#include <facemap/color.h>
#include <facemap/vector.h>
#include <pybind11/numpy.h>

#include <array>
#include <cstddef>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace facemap::python {

namespace py = pybind11;

/// Rows of numbers as the package's Python part hands them over: of the very type, C-contiguous, aligned. Others are
/// refused with TypeError.
template <typename Number>
using Rows = py::array_t<Number, py::array::c_style>;

using Triple = std::array<double, 3>;

inline Vector vector_of(const Triple& t) {
  return {static_cast<float>(t[0]), static_cast<float>(t[1]), static_cast<float>(t[2])};
}
inline Color color_of(const Triple& t) {
  return {static_cast<float>(t[0]), static_cast<float>(t[1]), static_cast<float>(t[2])};
}
inline Triple triple_of(const Vector& v) { return {v.x, v.y, v.z}; }
inline Triple triple_of(const Color& c) { return {c.r, c.g, c.b}; }

/// Throws ValueError unless the array is aligned and has the shape (n, columns), or (n,) for 0 columns.
void check_rows(const py::array& array, py::ssize_t columns);

/// The array's memory as elements of `Row`: Vector for (n, 3), Number for (n,).
template <typename Row, typename Number>
std::span<const Row> rows_of(const Rows<Number>& array) {
  static_assert(sizeof(Row) % sizeof(Number) == 0 && std::is_trivially_copyable_v<Row>);
  check_rows(array, sizeof(Row) == sizeof(Number) ? 0 : py::ssize_t{sizeof(Row) / sizeof(Number)});
  return {reinterpret_cast<const Row*>(array.data()), static_cast<std::size_t>(array.shape(0))};
}

/// A read-only array of numbers that `owner` holds and keeps.
template <typename Number>
py::array borrowed(const Number* numbers, std::vector<py::ssize_t> shape, const py::handle& owner) {
  py::array array(py::dtype::of<Number>(), std::move(shape), numbers, owner);
  array.attr("setflags")(py::arg("write") = false);
  return array;
}

/// An array of rows of numbers that takes over what a call has made: of shape (n,) or (n, numbers of an element).
template <typename Number, typename Element>
py::array_t<Number> given(std::vector<Element>&& elements) {
  static_assert(sizeof(Element) % sizeof(Number) == 0 && std::is_trivially_copyable_v<Element>);
  auto* const kept = new std::vector<Element>(std::move(elements));
  const py::capsule owner(kept, [](void* vector) { delete static_cast<std::vector<Element>*>(vector); });
  std::vector<py::ssize_t> shape = {static_cast<py::ssize_t>(kept->size())};
  if (sizeof(Element) != sizeof(Number)) shape.push_back(py::ssize_t{sizeof(Element) / sizeof(Number)});
  return py::array_t<Number>(std::move(shape), reinterpret_cast<const Number*>(kept->data()), owner);
}

/// A new array's memory.
template <typename Number>
std::span<Number> elements_of(py::array_t<Number>& array) {
  return {array.mutable_data(), static_cast<std::size_t>(array.size())};
}

/// The same of booleans, as the library writes them.
std::span<std::uint8_t> bytes_of(py::array_t<bool>& array);

}  // namespace facemap::python
