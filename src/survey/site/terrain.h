#pragma once

#include <cstdint>
#include <vector>

#include "survey/site/cell_grid.h"

namespace tera {

/// Where a terrain's heights come from. The numbers are those of mask.tif.
enum class HeightSource : std::uint8_t {
  kMeasured = 0,     ///< the median of the ground's points in the cell
  kFilled = 1,       ///< no points; the membrane over the gap (fill_gaps.h)
  kUnderThing = 2,   ///< a thing stands there, or within a cell; the membrane again
  kBeyondSurvey = 3  ///< outside of what was surveyed; the membrane, which runs out level
};

/// Heights of the ground by cells, without gaps, and what each rests on.
struct SurveyTerrain {
  CellGrid grid;
  std::vector<float> height_m;
  std::vector<HeightSource> source;

  /// Height at a place, bilinear between the cells' middles.
  double HeightAt(const Vec2& place_m) const;
  std::int64_t CountOf(HeightSource kind) const;
};

/// The terrain of a survey in cells. `above_m` says of each point how high it is above the ground;
/// up to 0 it is ground (ground_filter.h).
SurveyTerrain MakeTerrain(const std::vector<Vec3>& p_m, const std::vector<float>& above_m,
                          double cell_m);

}  // namespace tera
