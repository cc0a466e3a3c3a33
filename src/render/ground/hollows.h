#pragma once

#include <vector>

namespace tera {

/// Level of the water that stands in each cell's hollow: as high as the hollow's brim, but no
/// higher than `most_m` above its bottom; kDry where none does.
///
/// Frames  heights in metres, `width` x `height` cells, x fastest; water runs off over the border.
/// Model   a hollow is a connected part that lies below the level to which a flood from the border
///         fills it, found by priority flood; beside steps of that level hollows are apart.
/// Omits   how much rain has fallen and where it ran from; water that seeps away.
/// Source  Barnes, Lehman and Mulla 2014, "Priority-flood", Computers and Geosciences 62, algorithm
///         1.
std::vector<float> WaterLevels(const std::vector<float>& height_m, int width, int height,
                               double most_m);

inline constexpr float kDry = -1e9f;

}  // namespace tera
