#pragma once

#include <vector>

namespace tera {

/// Level of the standing water in each cell, or kDry. Water fills a hollow up to its brim, but at
/// most `most_m` above its lowest cell.
///
/// Frames  heights in m, `width` x `height` cells, x fastest. Water drains over the border.
/// Model   priority flood computes the level at which water would overflow towards the border. A
///         hollow is a connected region that lies below this level. Regions of different level are
///         separate hollows.
/// Omits   amount of rain, run-off paths, infiltration.
/// Source  Barnes, Lehman and Mulla 2014, "Priority-flood", Computers and Geosciences 62, algorithm
///         1.
std::vector<float> WaterLevels(const std::vector<float>& height_m, int width, int height,
                               double most_m);

inline constexpr float kDry = -1e9f;

}  // namespace tera
