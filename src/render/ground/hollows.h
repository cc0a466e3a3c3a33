#pragma once

#include <vector>

namespace tera {

/// Level of standing water in each cell: the hollow's brim, limited to `most_m` above the hollow's
/// bottom; kDry without water.
///
/// Frames  heights in metres, `width` x `height` cells, x fastest; water drains over the border.
/// Model   a hollow is a connected region below its flood level, which priority flood computes from
///         the border. Steps of the flood level separate hollows.
/// Omits   rain amount and run-off paths; infiltration.
/// Source  Barnes, Lehman and Mulla 2014, "Priority-flood", Computers and Geosciences 62, algorithm
///         1.
std::vector<float> WaterLevels(const std::vector<float>& height_m, int width, int height,
                               double most_m);

inline constexpr float kDry = -1e9f;

}  // namespace tera
