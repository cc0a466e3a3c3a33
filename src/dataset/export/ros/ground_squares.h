#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/motion.h"

namespace tera {

/// One raster layer of the ground.
///
/// Frames  W world; heights are z in W.
struct GroundSquares {
  Vec2 low_W_m = Vec2::Zero();  ///< south-western corner of the first cell
  double square_m = 1;
  int nx = 0, ny = 0;
  std::vector<float> values;  ///< row by row from the south, x fastest; NaN: unknown
};

/// Reads a ground raster of a recording as the named layer. Throws InputError on failure.
using ReadGround =
    std::function<GroundSquares(const std::filesystem::path& file, const std::string& layer)>;

}  // namespace tera
