#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/motion.h"

namespace tera {

/// Edge of a survey's terrain cells.
///
/// Model   The share of cells with points is counted within the blocks of 8 x 8 cells that hold
///         points. Without `wanted_m` the result is the finest of 0.05, 0.1, 0.2, 0.25, 0.5, 1 and
///         2 m with a share of at least half.
/// Throws  InputError for a wanted size with a share below a quarter or more than 2.5e7 cells, and
///         for points too sparse for any size.
double CellSize(const std::filesystem::path& file, const std::vector<Vec3>& p_m,
                const std::optional<double>& wanted_m);

}  // namespace tera
