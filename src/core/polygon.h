#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/motion.h"

namespace tera {

/// The first pair of crossing sides of a closed polygon; nullopt if no sides cross. Side k runs
/// from corner k to the next corner, counted from 0. Touching ends do not count as a crossing.
std::optional<std::pair<std::size_t, std::size_t>> FirstCrossing(const std::vector<Vec2>& corners);

/// Area of a closed polygon without crossings. The orientation does not matter.
double AreaOf(const std::vector<Vec2>& corners);

}  // namespace tera
