#pragma once

#include <cstdint>
#include <vector>

#include "survey/site/cell_grid.h"

namespace tera {

/// Source of a terrain height. The values are those of mask.tif.
enum class HeightSource : std::uint8_t {
  kMeasured = 0,     ///< median of the ground points in the cell
  kFilled = 1,       ///< no points; the membrane over the gap (fill_gaps.h)
  kUnderThing = 2,   ///< a thing stands within a cell of it; the membrane again
  kBeyondSurvey = 3  ///< outside the survey; the membrane, which runs out level
};

/// Ground heights by cell, without gaps, and the source of each.
struct SurveyTerrain {
  CellGrid grid;
  std::vector<float> height_m;
  std::vector<HeightSource> source;

  /// Height at a place, bilinear between the cells' middles.
  double HeightAt(const Vec2& place_m) const;
  std::int64_t CountOf(HeightSource kind) const;
};

/// The terrain of a survey. `above_m` is the height of each point above the ground; ground points
/// have at most 0 (ground_filter.h).
SurveyTerrain MakeTerrain(const std::vector<Vec3>& p_m, const std::vector<float>& above_m,
                          double cell_m);

}  // namespace tera
