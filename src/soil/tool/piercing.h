#pragma once

#include <vector>

#include "soil/soil.h"
#include "soil/tool/cut_soil.h"

namespace tera {

/// Pressure on a steel edge of some thickness that is pushed into each of several soils.
///
/// Model   The pressure is 10 % of the bearing pressure at 0.5 m at the surface. It grows with
///         depth to all of it at 0.5 m, and no more below. It is zero above the ground. Loose soil
///         has no cohesion.
/// Source  penetration resistance as in Algoryx's terrain material.
class Piercing {
 public:
  Piercing(const std::vector<SoilType>& soils, double thickness_m);
  double Pressure_pa(const CutSoil& soil, double depth_m) const;

 private:
  std::vector<double> full_pa_, full_loose_pa_;  ///< of each soil
};

}  // namespace tera
