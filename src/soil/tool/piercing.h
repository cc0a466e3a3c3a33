#pragma once

#include <vector>

#include "soil/soil.h"
#include "soil/tool/cut_soil.h"

namespace tera {

/// Pressure on a steel edge that is pushed into soil.
///
/// Model   The reference is the bearing pressure at 0.5 m depth. The pressure rises linearly from
///         10 % of it at the surface to 100 % at 0.5 m, and is constant below. Above the ground it
///         is zero. Loose soil has no cohesion.
/// Source  Penetration resistance as in the terrain material of Algoryx.
class Piercing {
 public:
  Piercing(const std::vector<SoilType>& soils, double thickness_m);
  double Pressure_pa(const CutSoil& soil, double depth_m) const;

 private:
  std::vector<double> full_pa_, full_loose_pa_;  ///< one for each soil
};

}  // namespace tera
