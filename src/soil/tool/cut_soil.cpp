#include "soil/tool/cut_soil.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

constexpr double kThinnest_m = 1e-6;  ///< thinner layers are skipped

/// Sums over the soil from the surface down, weighted by thickness.
struct Passed {
  double thickness_m = 0, kgpm2 = 0;
  double friction_m = 0, tool_friction_m = 0, cohesion_pam = 0, adhesion_pam = 0;

  void Add(double d_m, double density_kgpm3, const SoilType& type, bool is_loose) {
    thickness_m += d_m;
    kgpm2 += d_m * density_kgpm3;
    friction_m += d_m * std::tan(type.friction_angle_rad);
    tool_friction_m += d_m * std::tan(type.soil_tool_friction_rad);
    cohesion_pam += is_loose ? 0 : d_m * type.cohesion_pa;
    adhesion_pam += d_m * type.adhesion_pa;
  }
  CutLayer Mean() const {
    return {.thickness_m = thickness_m,
            .density_kgpm3 = kgpm2 / thickness_m,
            .friction_rad = std::atan(friction_m / thickness_m),
            .tool_friction_rad = std::atan(tool_friction_m / thickness_m),
            .cohesion_pa = cohesion_pam / thickness_m,
            .adhesion_pa = adhesion_pam / thickness_m};
  }
};

/// Collects layers of equal strength, and the mean of all.
class Collector {
 public:
  explicit Collector(const std::vector<SoilType>& soils) : soils_(soils) {}

  void Add(double d_m, double density_kgpm3, std::uint8_t soil, bool is_loose) {
    if (all_.thickness_m > 0 && !IsAsStrong(soil, is_loose) &&
        cut_.layer_count + 1 < CutSoil::kMostLayers) {
      EndLayer();
    }
    all_.Add(d_m, density_kgpm3, soils_[soil], is_loose);
    layer_.Add(d_m, density_kgpm3, soils_[soil], is_loose);
    cut_.at_edge = soil;
    cut_.edge_in_loose = is_loose;
  }
  CutSoil End() {
    EndLayer();
    cut_.mean = all_.Mean();
    return cut_;
  }

 private:
  /// True if the soil is as strong as the one added last.
  bool IsAsStrong(std::uint8_t soil, bool is_loose) const {
    const SoilType &a = soils_[cut_.at_edge], &b = soils_[soil];
    return (cut_.edge_in_loose ? 0 : a.cohesion_pa) == (is_loose ? 0 : b.cohesion_pa) &&
           a.friction_angle_rad == b.friction_angle_rad &&
           a.soil_tool_friction_rad == b.soil_tool_friction_rad && a.adhesion_pa == b.adhesion_pa;
  }
  void EndLayer() {
    cut_.layer[cut_.layer_count] = layer_.Mean();
    cut_.layer[cut_.layer_count++].is_loose = cut_.edge_in_loose;
    layer_ = {};
  }

  const std::vector<SoilType>& soils_;
  Passed all_, layer_;
  CutSoil cut_;
};

}  // namespace

CutSoil SoilAbove(ColumnId k, double z_m, const Columns& ground,
                  const std::vector<SoilType>& soils) {
  const Column& c = ground.at(k);
  Collector collector(soils);
  double rest_m = std::max(c.top_m - z_m, kThinnest_m);
  for (int n = c.layer_count - 1; n >= 0 && rest_m > 0; --n) {
    const SoilLayer& layer = c.layers[n];
    if (layer.thickness_m < kThinnest_m) continue;
    const double d_m = std::min(rest_m, layer.thickness_m);
    collector.Add(d_m, layer.density_kgpm3(), layer.soil, layer.loose);
    rest_m -= d_m;
  }
  double depth_m = c.ground_m - c.bank_m;
  while (rest_m > 0) {
    const Stratum& stratum = ground.ProfileOf(k).Below(depth_m);
    const double d_m = std::min(rest_m, std::max(stratum.bottom_m - depth_m, kThinnest_m));
    collector.Add(d_m, stratum.density_kgpm3, stratum.soil, false);
    rest_m -= d_m;
    depth_m += d_m;
  }
  return collector.End();
}

}  // namespace tera
