#include "soil/tool/cut_soil.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr double kThinnest_m = 1e-6;  ///< thinner soil says nothing

/// Sums over what has been passed on the way down.
struct Passed {
  double thickness_m = 0, kgpm2 = 0;
  double friction_m = 0, tool_friction_m = 0, cohesion_pam = 0, adhesion_pam = 0;
  std::uint8_t soil = 0;
  bool loose = false;

  void Add(double d_m, double density_kgpm3, std::uint8_t of, bool is_loose,
           const std::vector<SoilType>& soils) {
    const SoilType& type = soils[of];
    thickness_m += d_m;
    kgpm2 += d_m * density_kgpm3;
    friction_m += d_m * std::tan(type.friction_angle_rad);
    tool_friction_m += d_m * std::tan(type.soil_tool_friction_rad);
    cohesion_pam += is_loose ? 0 : d_m * type.cohesion_pa;
    adhesion_pam += d_m * type.adhesion_pa;
    soil = of;
    loose = is_loose;
  }
};

}  // namespace

CutSoil SoilAbove(ColumnId k, double z_m, const Columns& ground,
                  const std::vector<SoilType>& soils) {
  const Column& c = ground.at(k);
  Passed passed;
  double rest_m = std::max(c.top_m - z_m, kThinnest_m);
  for (int n = c.layer_count - 1; n >= 0 && rest_m > 0; --n) {
    const SoilLayer& layer = c.layers[n];
    if (layer.thickness_m < kThinnest_m) continue;
    const double d_m = std::min(rest_m, layer.thickness_m);
    passed.Add(d_m, layer.density_kgpm3(), layer.soil, layer.loose, soils);
    rest_m -= d_m;
  }
  double depth_m = c.ground_m - c.bank_m;
  while (rest_m > 0) {
    const Stratum& stratum = ground.ProfileOf(k).Below(depth_m);
    const double d_m = std::min(rest_m, std::max(stratum.bottom_m - depth_m, kThinnest_m));
    passed.Add(d_m, stratum.density_kgpm3, stratum.soil, false, soils);
    rest_m -= d_m;
    depth_m += d_m;
  }
  const double all_m = passed.thickness_m;
  return {.density_kgpm3 = passed.kgpm2 / all_m,
          .friction_rad = std::atan(passed.friction_m / all_m),
          .tool_friction_rad = std::atan(passed.tool_friction_m / all_m),
          .cohesion_pa = passed.cohesion_pam / all_m,
          .adhesion_pa = passed.adhesion_pam / all_m,
          .at_edge = passed.soil,
          .edge_in_loose = passed.loose};
}

}  // namespace tera
