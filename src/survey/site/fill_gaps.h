#pragma once

#include <vector>

#include "survey/site/cell_grid.h"

namespace tera {

/// Fills every unknown height (NaN). At least one cell must be known.
///
/// Model   A membrane over the gap: Laplace's equation with the known neighbours as boundary
///         values. The slope across the border of the grid is zero. If the cells around a gap lie
///         in a plane, the gap becomes part of the plane.
/// Source  solved by conjugate gradients, with coarser grids as initial guess.
void FillGaps(const CellGrid& grid, std::vector<float>* height_m);

}  // namespace tera
