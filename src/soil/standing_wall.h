#pragma once

#include <vector>

#include "soil/columns.h"

namespace tera {

/// Greatest height at which a bank of slope `slope_rad` stands (infinite below the friction angle).
/// Source  Culmann's wedge: Das, Principles of Geotechnical Engineering, ch. 15.
double CulmannHeight_m(const SoilType& soil, double slope_rad);

/// Banks, and which of them are too high to stand.
///
/// Model   A bank stands up to Culmann's critical height for its slope, looking down over several
///         columns in eight directions. What stands above that height, or above the slope of
///         internal friction where that is more, fails.
/// Omits   surcharge behind the edge, water in cracks, undercut banks.
class StandingWalls {
 public:
  explicit StandingWalls(const std::vector<SoilType>& soils);
  /// Height of what cannot stand at the top of a column; none where loose soil lies on it.
  double Overhang_m(ColumnId k, const Columns& ground) const;

 private:
  struct Limit {
    double tan_stand;  ///< of the slope that stands at any height
    double upright_m;  ///< critical height of an upright wall
  };
  std::vector<Limit> limits_;  ///< one for each soil
};

}  // namespace tera
