#include "arrays.h"

#include <string>

namespace facemap::python {

void check_rows(const py::array& array, py::ssize_t columns) {
  const bool has_shape = columns == 0 ? array.ndim() == 1 : array.ndim() == 2 && array.shape(1) == columns;
  if (!has_shape) throw py::value_error("an array of " + std::to_string(columns) + " columns is needed");
  if (!(array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_)) throw py::value_error("the array is not aligned");
}

std::span<std::uint8_t> bytes_of(py::array_t<bool>& array) {
  static_assert(sizeof(bool) == 1);
  return {reinterpret_cast<std::uint8_t*>(array.mutable_data()), static_cast<std::size_t>(array.size())};
}

}  // namespace facemap::python
