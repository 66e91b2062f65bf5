#include "picture/direction_table.h"

#include "parallel/executor.h"
#include "picture/sample_grid.h"

namespace facemap {

std::shared_ptr<const DirectionTable> make_directions(const SampleGrid& grid, const Executor& executor) {
  const auto table = std::make_shared<DirectionTable>();
  for (UnsetVector<float>* component : {&table->x, &table->y, &table->z}) component->resize(grid.count());
  const auto columns = static_cast<std::size_t>(grid.columns());
  executor.for_each(static_cast<std::size_t>(grid.rows()), [&](std::size_t row, int) {
    for (std::size_t column = 0; column < columns; ++column) {
      const Vector d = grid.direction_through(grid.map_point(static_cast<int>(column), static_cast<int>(row)));
      const std::size_t sample = row * columns + column;
      table->x[sample] = d.x;
      table->y[sample] = d.y;
      table->z[sample] = d.z;
    }
  });
  return table;
}

}  // namespace facemap
