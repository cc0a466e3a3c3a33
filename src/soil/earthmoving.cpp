#include "soil/earthmoving.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace tera {
namespace {

constexpr double kMargin_rad = 0.5 * kDeg;  ///< kept from the ends of the range of wedge angles
constexpr double kLeastRake_rad = 5 * kDeg;
constexpr double kSteepestRake_rad = 150 * kDeg;
/// A wedge has at least this range of angles: tools that lean further forward push it as one that
/// just leaves this much. Without room for a wedge its equilibrium has a pole.
constexpr double kLeastRange_rad = 10 * kDeg;

double Cot(double a) { return 1 / std::tan(a); }

/// P for one wedge angle, cohesion of the flanks included.
double ForceAt_n(const CuttingInput& in, double wedge_rad) {
  const CuttingFactors n = CuttingFactorsAt(in, wedge_rad);
  const double weight_npm3 = in.density_kgpm3 * kStandardGravity_mps2;
  const double d = in.depth_m;
  double cohesive_npm = in.cohesion_pa * d;
  if (in.flank_share > 0) {
    const double at_rest = 1 - std::sin(in.friction_rad);  // Jaky
    const double area_m2 = 0.5 * d * d * Cot(wedge_rad);
    const double shear_n =
        2 * in.flank_share * area_m2 *
        (in.cohesion_pa + at_rest * weight_npm3 * d / 3 * std::tan(in.friction_rad));
    // N_c counts c over the slip plane of length d / sin(beta).
    cohesive_npm += shear_n * std::sin(wedge_rad) / in.width_m;
  }
  return in.width_m * (weight_npm3 * d * d * n.n_gamma + cohesive_npm * n.n_c +
                       in.adhesion_pa * d * n.n_a + in.surcharge_pa * d * n.n_q +
                       in.density_kgpm3 * in.speed_mps * in.speed_mps * d * n.inertia);
}

}  // namespace

CuttingFactors CuttingFactorsAt(const CuttingInput& in, double wedge_rad) {
  const double contact = in.rake_rad + in.tool_friction_rad;
  const double slip = Cot(wedge_rad + in.friction_rad);
  const double D = std::cos(contact) + std::sin(contact) * slip;
  CuttingFactors n;
  n.wedge_rad = wedge_rad;
  // The slip plane comes out where it meets a surface that rises by the slope.
  const double ahead = 1 / (std::tan(wedge_rad) - std::tan(in.slope_rad));
  n.n_q = (Cot(in.rake_rad) + ahead) / D;
  n.n_gamma = 0.5 * n.n_q;
  n.n_c = (1 + Cot(wedge_rad) * slip) * ahead * std::tan(wedge_rad) / D;
  n.n_a = (1 - Cot(in.rake_rad) * slip) / D;
  n.inertia = (std::tan(wedge_rad) + slip) / (1 + std::tan(wedge_rad) * Cot(in.rake_rad)) / D;
  return n;
}

CuttingForce Cut(const CuttingInput& input) {
  CuttingForce result;
  if (input.depth_m <= 0) return result;
  CuttingInput in = input;
  double low = std::max(0.0, in.slope_rad) + 4 * kMargin_rad;
  const double leans_to = kPi - in.tool_friction_rad - in.friction_rad - kMargin_rad;
  const double steepest =
      std::max(kLeastRake_rad, std::min(kSteepestRake_rad, leans_to - low - kLeastRange_rad));
  in.rake_rad = std::clamp(in.rake_rad, kLeastRake_rad, steepest);
  double high =
      std::max(low + kMargin_rad, std::min(kPi / 2 - kMargin_rad, leans_to - in.rake_rad));
  constexpr double kGolden = 0.6180339887498949;
  constexpr int kSections = 28;  // 90 deg * 0.618^28 is 1e-4 deg
  double a = high - kGolden * (high - low), b = low + kGolden * (high - low);
  double at_a = ForceAt_n(in, a), at_b = ForceAt_n(in, b);
  for (int k = 0; k < kSections; ++k) {
    if (at_a < at_b) {
      high = b, b = a, at_b = at_a;
      a = high - kGolden * (high - low), at_a = ForceAt_n(in, a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + kGolden * (high - low), at_b = ForceAt_n(in, b);
    }
  }
  result.wedge_rad = 0.5 * (low + high);
  result.total_n = std::max(0.0, ForceAt_n(in, result.wedge_rad));
  result.draft_n = result.total_n * std::sin(in.rake_rad + in.tool_friction_rad);
  result.vertical_n = result.total_n * std::cos(in.rake_rad + in.tool_friction_rad);
  result.wedge_length_m = in.depth_m * Cot(result.wedge_rad);
  return result;
}

}  // namespace tera
