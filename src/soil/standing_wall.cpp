#include "soil/standing_wall.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kVeneer_m = 0.01;  ///< more loose soil than this covers what stands below
constexpr int kLookDown = 12;       ///< columns over which a bank's height is measured

struct Direction {
  int di, dj;
  double distance;  ///< in cells
};
const std::array<Direction, 8> kDirections = {{{1, 0, 1},
                                               {-1, 0, 1},
                                               {0, 1, 1},
                                               {0, -1, 1},
                                               {1, 1, std::sqrt(2.0)},
                                               {-1, -1, std::sqrt(2.0)},
                                               {1, -1, std::sqrt(2.0)},
                                               {-1, 1, std::sqrt(2.0)}}};

}  // namespace

double CulmannHeight_m(const SoilType& soil, double slope_rad) {
  if (slope_rad <= soil.friction_angle_rad) return std::numeric_limits<double>::infinity();
  if (soil.cohesion_pa == 0) return 0;
  return 4 * soil.cohesion_pa / (soil.bank_density_kgpm3 * kStandardGravity_mps2) *
         std::sin(slope_rad) * std::cos(soil.friction_angle_rad) /
         (1 - std::cos(slope_rad - soil.friction_angle_rad));
}

StandingWalls::StandingWalls(const std::vector<SoilType>& soils) {
  for (const SoilType& soil : soils) {
    limits_.push_back({std::tan(std::max(soil.friction_angle_rad, soil.repose_angle_rad)),
                       CulmannHeight_m(soil, kPi / 2)});
  }
}

double StandingWalls::Overhang_m(ColumnId k, const Columns& ground) const {
  const Columns::Skin& c = ground.skin(k);
  if (c.loose_m > kVeneer_m) return 0;
  const std::uint8_t material = ground.soil_at(k);
  const SoilType& soil = ground.soils()[material];
  const auto [i, j] = ground.PlaceOf(k);
  double overhang_m = 0;
  for (const auto& [di, dj, distance] : kDirections) {
    const double run_m = distance * ground.cell_m();
    const Columns::Skin* beside = ground.Beside(k, di, dj);
    if (beside != nullptr && c.top_m - beside->top_m <= limits_[material].tan_stand * run_m) {
      continue;  // no edge on this side
    }
    for (int m = 1; m <= kLookDown && ground.Contains(i + m * di, j + m * dj); ++m) {
      const double drop_m = c.top_m - ground.TopAt(i + m * di, j + m * dj);
      const double slope_m = limits_[material].tan_stand * m * run_m;
      if (m == 1 && drop_m <= slope_m) break;  // no edge on this side
      const double stands_m = std::max(limits_[material].upright_m, slope_m);
      if (drop_m <= stands_m) continue;
      if (drop_m <= CulmannHeight_m(soil, std::atan2(drop_m, m * run_m))) continue;
      overhang_m = std::max(overhang_m, drop_m - stands_m);
    }
  }
  return overhang_m;
}

}  // namespace tera
