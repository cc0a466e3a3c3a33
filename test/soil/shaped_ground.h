#pragma once

#include <utility>

#include "soil_fixture.h"

namespace tera::testing_soil {

/// Undisturbed ground of n x n columns, centred on W's origin, as high as `height_m(x, y)` says.
template <typename Height>
Columns ShapedColumns(const SoilType& soil, double cell_m, int n, Height height_m) {
  const Columns level = LevelColumns(soil, cell_m, n);
  UndisturbedGround ground = level.undisturbed();
  ground.base_cells = 1;
  ground.base_height_m.clear();
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      ground.base_height_m.push_back(static_cast<float>(height_m(level.x_m(i), level.y_m(j))));
    }
  }
  return Columns(std::move(ground), {soil});
}

}  // namespace tera::testing_soil
