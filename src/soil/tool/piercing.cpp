#include "soil/tool/piercing.h"

#include <algorithm>

#include "soil/columns/soil_type.h"

namespace tera {
namespace {

constexpr double kFullDepth_m = 0.5, kAtSurface = 0.1;

}  // namespace

Piercing::Piercing(const std::vector<SoilType>& soils, double thickness_m) {
  for (SoilType soil : soils) {
    full_pa_.push_back(BearingPressure_pa(soil, thickness_m, kFullDepth_m));
    soil.cohesion_pa = 0;
    full_loose_pa_.push_back(BearingPressure_pa(soil, thickness_m, kFullDepth_m));
  }
}

double Piercing::Pressure_pa(const CutSoil& soil, double depth_m) const {
  if (depth_m <= 0) return 0;
  return (kAtSurface + (1 - kAtSurface) * std::min(1.0, depth_m / kFullDepth_m)) *
         (soil.edge_in_loose ? full_loose_pa_ : full_pa_)[soil.at_edge];
}

}  // namespace tera
