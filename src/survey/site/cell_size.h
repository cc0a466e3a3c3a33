#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Edge of the terrain cells of a survey.
///
/// Model   Coverage is the fraction of cells with points, within those blocks of 8 x 8 cells that
///         contain points. Without `wanted_m`, the result is the finest of 0.05, 0.1, 0.2, 0.25,
///         0.5, 1 and 2 m with a coverage of at least half.
/// Throws  InputError if `wanted_m` has a coverage below a quarter or more than 2.5e7 cells, or if
///         the points are too sparse for every size.
double CellSize(const std::filesystem::path& file, const std::vector<Vec3>& p_m,
                const std::optional<double>& wanted_m);

}  // namespace tera
