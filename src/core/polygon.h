#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/motion.h"

namespace tera {

/// The first two sides of a closed polygon that cross, counted from 0; side k goes from corner k to
/// the next one. Ends that touch do not count.
std::optional<std::pair<std::size_t, std::size_t>> FirstCrossing(const std::vector<Vec2>& corners);

/// Area of a closed polygon that does not cross itself, whichever way round.
double AreaOf(const std::vector<Vec2>& corners);

}  // namespace tera
