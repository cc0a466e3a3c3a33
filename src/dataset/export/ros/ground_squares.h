#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/motion.h"

namespace tera {

/// One layer of the ground in squares of the world.
///
/// Frames  W; heights are z of W.
struct GroundSquares {
  Vec2 low_W_m = Vec2::Zero();  ///< south-western corner of the first square
  double square_m = 1;
  int nx = 0, ny = 0;
  std::vector<float> values;  ///< row by row from the south, x fastest; NaN: unknown
};

/// Reads the raster `file` of a recording's ground as the layer of that name. Throws InputError.
using ReadGround =
    std::function<GroundSquares(const std::filesystem::path& file, const std::string& layer)>;

}  // namespace tera
