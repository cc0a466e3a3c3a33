#pragma once

#include <cstdint>
#include <vector>

#include "survey/site/cell_grid.h"

namespace tera {

/// Origin of a terrain height. The values are those of mask.tif.
enum class HeightSource : std::uint8_t {
  kMeasured = 0,     ///< median of the ground points in the cell
  kFilled = 1,       ///< a cell without points, filled by the membrane of fill_gaps.h
  kUnderThing = 2,   ///< an object is within one cell; filled in the same way
  kBeyondSurvey = 3  ///< outside the survey; filled in the same way, and level far away
};

/// Ground height of each cell, without gaps, and where it comes from.
struct SurveyTerrain {
  CellGrid grid;
  std::vector<float> height_m;
  std::vector<HeightSource> source;

  /// Height at a place, interpolated bilinearly between cell centres.
  double HeightAt(const Vec2& place_m) const;
  std::int64_t CountOf(HeightSource kind) const;
};

/// Terrain of a survey. `above_m` is the height of each point above the ground, which is 0 or less
/// for a ground point (ground_filter.h).
SurveyTerrain MakeTerrain(const std::vector<Vec3>& p_m, const std::vector<float>& above_m,
                          double cell_m);

}  // namespace tera
