#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/motion.h"

namespace tera {

/// The side of a terrain's cells for a survey.
///
/// Model   Of the cells in all blocks of 8 x 8 that have points, some have points themselves: their
///         share. Without `wanted_m`, the finest of 0.05, 0.1, 0.2, 0.25, 0.5, 1 and 2 m of which
///         at least half have.
/// Throws  InputError for a wanted size at which fewer than a quarter have points, for one that
///         gives more than 2.5e7 cells, and for points too sparse for any.
double CellSize(const std::filesystem::path& file, const std::vector<Vec3>& p_m,
                const std::optional<double>& wanted_m);

}  // namespace tera
