#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/motion.h"

namespace tera {

/// The first two crossing sides of a closed polygon, counted from 0. Side k joins corner k to the
/// next corner. Touching ends do not count.
std::optional<std::pair<std::size_t, std::size_t>> FirstCrossing(const std::vector<Vec2>& corners);

/// Area of a closed polygon that does not cross itself, in either orientation.
double AreaOf(const std::vector<Vec2>& corners);

}  // namespace tera
