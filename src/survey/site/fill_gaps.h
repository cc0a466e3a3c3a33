#pragma once

#include <vector>

#include "survey/site/cell_grid.h"

namespace tera {

/// Fills each unknown height (NaN).
///
/// Model   a membrane over the gap: Laplace's equation over the unknown cells, with their known
///         neighbours as boundary. Its slope is zero across the grid's border. A plane around a gap
///         continues through it. At least one cell must be known.
/// Source  conjugate gradients, started from coarser grids.
void FillGaps(const CellGrid& grid, std::vector<float>* height_m);

}  // namespace tera
