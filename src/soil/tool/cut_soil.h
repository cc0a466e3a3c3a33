#pragma once

#include <vector>

#include "soil/columns/columns.h"
#include "soil/soil.h"

namespace tera {

/// What an edge at some depth cuts through: means over the layers and strata above it, each by its
/// thickness, and the soil that the edge itself meets.
///
/// Model   Loose soil has lost its cohesion; friction is the mean of its tangent.
struct CutSoil {
  double density_kgpm3 = 0;
  double friction_rad = 0;
  double tool_friction_rad = 0;
  double cohesion_pa = 0;
  double adhesion_pa = 0;
  std::uint8_t at_edge = 0;  ///< soil that the edge meets
  bool edge_in_loose = false;
};

/// The soil of a column above z_m, of which `soils` are the properties. At least that of the
/// surface.
CutSoil SoilAbove(ColumnId k, double z_m, const Columns& ground,
                  const std::vector<SoilType>& soils);

}  // namespace tera
