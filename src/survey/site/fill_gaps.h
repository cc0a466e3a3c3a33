#pragma once

#include <vector>

#include "survey/site/cell_grid.h"

namespace tera {

/// Gives a height to each cell that has none (NaN).
///
/// Model   the membrane that hangs in the gap: Laplace's equation over the unknown cells, their
///         known neighbours as its border, level across the grid's own border. A plane about a gap
///         goes through it unchanged. At least one cell must be known.
/// Source  conjugate gradients from a guess by halved grids.
void FillGaps(const CellGrid& grid, std::vector<float>* height_m);

}  // namespace tera
