#include "soil/tool/layered_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kWedgeLength = 2;  ///< length of the wedge ahead of a vertical blade, in depths

/// Horizontal and vertical force on a part of a blade.
struct Force {
  double draft_n = 0, vertical_n = 0;

  Force operator+(const Force& b) const { return {draft_n + b.draft_n, vertical_n + b.vertical_n}; }
};

/// The layers above a layer, at the blade. A heap of loose soil on top may become lower ahead.
class Above {
 public:
  double depth_m() const { return depth_m_; }
  double flank_npm() const { return flank_npm_; }
  /// True if the top layer is loose.
  bool has_heap() const { return heap_m_ > 0; }
  /// Mean weight over a length of ground, where the height of the heap falls at the slope `falls`.
  double WeightOver_pa(double length_m, double falls) const {
    return weight_pa_ - heap_pa_ * (1 - HeapOver(falls * length_m));
  }
  void Add(const CutLayer& layer, double thickness_m) {
    const double weight_pa = layer.density_kgpm3 * kStandardGravity_mps2 * thickness_m;
    // coefficient of earth pressure at rest (Jaky)
    const double at_rest = 1 - std::sin(layer.friction_rad);
    const double normal_pa = at_rest * (weight_pa_ + 0.5 * weight_pa);
    flank_npm_ += thickness_m * (layer.cohesion_pa + normal_pa * std::tan(layer.friction_rad));
    if (layer.is_loose && heap_m_ == depth_m_) {
      heap_m_ += thickness_m;
      heap_pa_ += weight_pa;
    }
    weight_pa_ += weight_pa;
    depth_m_ += thickness_m;
  }

 private:
  /// Mean height of the heap over its height at the blade, if it falls by `fall_m` in total.
  double HeapOver(double fall_m) const {
    if (fall_m <= 0 || heap_m_ <= 0) return 1;
    return fall_m > heap_m_ ? 0.5 * heap_m_ / fall_m : 1 - 0.5 * fall_m / heap_m_;
  }

  double depth_m_ = 0, weight_pa_ = 0, flank_npm_ = 0;
  double heap_m_ = 0, heap_pa_ = 0;
};

/// Layers of a cut, each as an input of its own under the weight of those above.
struct Slices {
  std::array<CuttingInput, CutSoil::kMostLayers> in;
  int count = 0;

  Slices(const CuttingInput& blade, std::span<const CutLayer> layers) {
    Above above;
    for (const CutLayer& layer : layers) {
      const bool is_last = &layer == &layers.back();
      const double rest_m = blade.depth_m - above.depth_m();
      if (rest_m <= 0) break;
      CuttingInput& slice = in[count++] = InSoilOf(layer, blade);
      slice.depth_m = is_last ? rest_m : std::min(rest_m, layer.thickness_m);
      if (above.has_heap() && !layer.is_loose) slice.slope_rad = blade.firm_slope_rad;
      slice.overburden_pa = above.WeightOver_pa(
          kWedgeLength * slice.depth_m, std::tan(slice.slope_rad) - std::tan(blade.slope_rad));
      slice.flank_above_npm = above.flank_npm();
      above.Add(layer, slice.depth_m);
    }
  }
};

Force ForceOn(const CuttingInput& slice) {
  const CuttingForce force = Cut(slice);
  return {force.draft_n, force.vertical_n};
}

/// Passive thrust of a layer on a vertical plane.
double Rankine_n(CuttingInput slice) {
  slice.rake_rad = kPi / 2;
  slice.tool_friction_rad = slice.adhesion_pa = slice.speed_mps = 0;
  return Cut(slice).total_n;
}

/// Shear strength of a soil at the top of a slice.
double StrengthAtTop_pa(const CuttingInput& soil, double overburden_pa) {
  return soil.cohesion_pa + (overburden_pa + soil.surcharge_pa) * std::tan(soil.friction_rad);
}

/// Force that pushes the layers above slice `n` as a block over that slice. Infinite if friction on
/// the blade jams the block.
Force BlockOn(const Slices& slices, int n) {
  const CuttingInput& seam = slices.in[n];
  double thickness_m = 0, ahead_n = 0, adhesion_npm = 0, tool_friction_m = 0;
  for (int k = 0; k < n; ++k) {
    const CuttingInput& slice = slices.in[k];
    thickness_m += slice.depth_m;
    ahead_n += Rankine_n(slice);
    adhesion_npm += slice.depth_m * slice.adhesion_pa;
    tool_friction_m += slice.depth_m * std::tan(slice.tool_friction_rad);
  }
  const double length_m = thickness_m;
  const double push_rad = seam.rake_rad + std::atan(tool_friction_m / thickness_m);
  const double rise = std::tan(seam.slope_rad + seam.friction_rad);
  const double hold = std::sin(push_rad) + std::cos(push_rad) * rise;
  const double weight_npm = (seam.overburden_pa + seam.surcharge_pa) * length_m;
  const double cohesive_npm = seam.cohesion_pa * length_m * std::cos(seam.friction_rad) /
                              std::cos(seam.slope_rad) /
                              std::cos(seam.slope_rad + seam.friction_rad);
  const double flanks_n = 2 * seam.flank_share * seam.flank_above_npm * length_m;
  const double adhesive_npm = adhesion_npm * (rise - 1 / std::tan(seam.rake_rad));
  const double force_n =
      ahead_n + flanks_n + seam.width_m * (weight_npm * rise + cohesive_npm + adhesive_npm);
  if (hold <= 0) return {std::numeric_limits<double>::infinity(), 0};
  const double total_n = std::max(0.0, force_n) / hold;
  return {total_n * std::sin(push_rad), total_n * std::cos(push_rad)};
}

}  // namespace

CuttingInput InSoilOf(const CutLayer& layer, CuttingInput in) {
  in.density_kgpm3 = layer.density_kgpm3;
  in.friction_rad = layer.friction_rad;
  in.tool_friction_rad = layer.tool_friction_rad;
  in.cohesion_pa = layer.cohesion_pa;
  in.adhesion_pa = layer.adhesion_pa;
  return in;
}

CuttingForce CutLayers(const CuttingInput& mean, std::span<const CutLayer> layers) {
  CuttingForce least = Cut(mean);
  if (layers.size() < 2 || mean.depth_m <= 0) return least;
  const Slices slices(mean, layers);
  const auto try_force = [&](const Force& force) {
    if (force.draft_n >= least.draft_n) return;
    least.draft_n = force.draft_n;
    least.vertical_n = force.vertical_n;
    least.total_n = std::hypot(force.draft_n, force.vertical_n);
  };
  std::array<Force, CutSoil::kMostLayers + 1> below;  // sum over this slice and all deeper ones
  for (int n = slices.count - 1; n >= 0; --n) below[n] = ForceOn(slices.in[n]) + below[n + 1];
  try_force(below[0]);
  for (int n = 1; n < slices.count; ++n) {
    const CuttingInput &above = slices.in[n - 1], &seam = slices.in[n];
    const double weight_pa = seam.overburden_pa;
    if (StrengthAtTop_pa(seam, weight_pa) >= StrengthAtTop_pa(above, weight_pa)) continue;
    try_force(BlockOn(slices, n) + below[n]);
  }
  return least;
}

namespace {

/// Fills in the mean densities of firm and loose soil, and the mean cohesion of the firm soil.
SoilAhead WithSoilOf(const CutSoil& cut, SoilAhead ahead) {
  CutLayer firm, loose;
  for (const CutLayer& layer : cut.layers()) {
    CutLayer& sum = layer.is_loose ? loose : firm;
    sum.thickness_m += layer.thickness_m;
    sum.density_kgpm3 += layer.thickness_m * layer.density_kgpm3;
    sum.cohesion_pa += layer.thickness_m * layer.cohesion_pa;
  }
  const auto density = [&](const CutLayer& sum) {
    return sum.thickness_m > 0 ? sum.density_kgpm3 / sum.thickness_m : cut.mean.density_kgpm3;
  };
  ahead.firm_density_kgpm3 = density(firm);
  ahead.loose_density_kgpm3 = density(loose);
  if (firm.thickness_m > 0) ahead.firm_cohesion_pa = firm.cohesion_pa / firm.thickness_m;
  return ahead;
}

/// Force in layered soil over force in soil of its mean, on level ground. It is 1 for loose soil on
/// firm soil of equal friction, because GroundAhead resolves that border.
double ShareOfLayers(const CuttingInput& in, const CutSoil& soil) {
  const bool heap_alone = soil.layer_count == 2 && soil.layer[0].is_loose &&
                          soil.layer[0].friction_rad == soil.layer[1].friction_rad;
  if (soil.layer_count < 2 || heap_alone) return 1;
  const double mean_n = Cut(in).draft_n;
  return mean_n > 0 ? std::min(1.0, CutLayers(in, soil.layers()).draft_n / mean_n) : 1;
}

}  // namespace

CuttingForce CutLayersAhead(const CuttingInput& blade, const GroundAhead& ground,
                            const CutSoil& soil, const SoilAhead& ahead) {
  CuttingInput in = InSoilOf(soil.mean, blade);
  in.depth_m = ground.depth_m();
  CuttingForce force = CutAhead(in, ground, WithSoilOf(soil, ahead));
  const double share = ShareOfLayers(in, soil);
  force.total_n *= share, force.draft_n *= share, force.vertical_n *= share;
  return force;
}

}  // namespace tera
