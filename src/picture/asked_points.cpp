#include "picture/asked_points.h"

#include <algorithm>
#include <glm/common.hpp>

namespace facemap {

DVector place_of(const AskedPoints& points, std::uint32_t point) {
  return points.origin + points.step * DVector(points.x[point], points.y[point], points.z[point]);
}

double error_of(const AskedPoints& points, std::uint32_t point) {
  const DVector p = place_of(points, point), size = glm::max(glm::abs(points.origin), glm::abs(p));
  return 2 * points.error + 0x1p-48 * std::max({size.x, size.y, size.z});
}

void copy_points(const AskedPoints& points, const std::vector<std::uint32_t>& numbers, std::size_t first,
                 AskedPoints& some) {
  some.origin = points.origin;
  some.step = points.step;
  some.error = points.error;
  for (auto* coordinates : {&some.x, &some.y, &some.z}) coordinates->resize(numbers.size());
  some.faces.resize(numbers.size());
  for (std::size_t k = first; k < numbers.size(); ++k) {
    const std::uint32_t i = numbers[k];
    some.x[k] = points.x[i];
    some.y[k] = points.y[i];
    some.z[k] = points.z[i];
    some.faces[k] = points.faces[i];
  }
}

}  // namespace facemap
