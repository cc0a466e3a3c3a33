#include "soil/tool/earthmoving.h"

#include <algorithm>
#include <cmath>

#include "core/units.h"
#include "soil/tool/curved_slip.h"
#include "soil/tool/golden_section.h"

namespace tera {
namespace {

constexpr double kMargin_rad = 0.5 * kDeg;  ///< distance from the ends of the range of wedge angles
constexpr double kLeastRake_rad = 5 * kDeg;
/// Least range of wedge angles. With less, the equilibrium has a pole within the range.
constexpr double kLeastRange_rad = 10 * kDeg;
constexpr int kSections = 20;  ///< 90 deg * 0.618^20 is 0.006 deg

double Cot(double a) { return 1 / std::tan(a); }

/// The equation for one tool in one soil, prepared for many wedge angles.
class Wedges {
 public:
  explicit Wedges(const CuttingInput& in)
      : in_(in),
        weight_npm3_(in.density_kgpm3 * kStandardGravity_mps2),
        cot_rake_(Cot(in.rake_rad)),
        cos_contact_(std::cos(in.rake_rad + in.tool_friction_rad)),
        sin_contact_(std::sin(in.rake_rad + in.tool_friction_rad)),
        tan_friction_(std::tan(in.friction_rad)),
        tan_slope_(std::tan(in.slope_rad)),
        rise_(1 + tan_slope_ * cot_rake_),
        at_rest_(1 - std::sin(in.friction_rad)) {}  // coefficient of earth pressure at rest (Jaky)

  CuttingFactors FactorsAt(double tan_wedge) const {
    // cotangent of the sum of wedge and friction angle
    const double slip = (1 - tan_wedge * tan_friction_) / (tan_wedge + tan_friction_);
    const double D = cos_contact_ + sin_contact_ * slip;
    const double ahead = Ahead(tan_wedge);
    CuttingFactors n;
    n.n_q = (cot_rake_ / rise_ + ahead) / D;
    n.n_gamma = 0.5 * n.n_q;
    n.n_c = (tan_wedge + slip) * ahead / D;
    n.n_a = (1 - cot_rake_ * slip) / rise_ / D;
    n.inertia = (tan_wedge + slip) * rise_ / (1 + tan_wedge * cot_rake_) / D;
    return n;
  }

  /// Length of ground ahead of the edge that the wedge lifts, in depths.
  double Ahead(double tan_wedge) const { return 1 / (tan_wedge - tan_slope_); }

  /// P, including the shear on the flanks.
  double ForceAt_n(double wedge_rad) const {
    const double tan_wedge = std::tan(wedge_rad);
    const CuttingFactors n = FactorsAt(tan_wedge);
    const double d = in_.depth_m;
    double cohesive_npm = in_.cohesion_pa * d;
    if (in_.flank_share > 0) {
      const double ahead = Ahead(tan_wedge);
      const double area_m2 = 0.5 * d * d * ahead;
      const double normal_pa = at_rest_ * (weight_npm3_ * d / 3 + in_.overburden_pa);
      const double shear_n = 2 * in_.flank_share *
                             (area_m2 * (in_.cohesion_pa + normal_pa * tan_friction_) +
                              in_.flank_above_npm * d * ahead);
      // N_c applies c over the slip plane, whose horizontal length is `ahead` times the depth.
      cohesive_npm += shear_n / (ahead * std::sqrt(1 + tan_wedge * tan_wedge)) / in_.width_m;
    }
    return in_.width_m *
           (weight_npm3_ * d * d * n.n_gamma + cohesive_npm * n.n_c + in_.adhesion_pa * d * n.n_a +
            (in_.surcharge_pa + in_.overburden_pa) * d * n.n_q +
            in_.density_kgpm3 * in_.speed_mps * in_.speed_mps * d * n.inertia);
  }

 private:
  const CuttingInput& in_;
  double weight_npm3_, cot_rake_, cos_contact_, sin_contact_, tan_friction_, tan_slope_;
  double rise_;  ///< depth at the edge over the height of the blade up to the surface
  double at_rest_;
};

}  // namespace

CuttingFactors CuttingFactorsAt(const CuttingInput& in, double wedge_rad) {
  CuttingFactors n = Wedges(in).FactorsAt(std::tan(wedge_rad));
  n.wedge_rad = wedge_rad;
  return n;
}

CuttingInput AsUpright(CuttingInput in) {
  const double leans_rad = in.rake_rad - kPi / 2;
  if (leans_rad <= 0) return in;
  in.rake_rad = kPi / 2;
  in.tool_friction_rad =
      std::min(in.tool_friction_rad + leans_rad, std::max(in.tool_friction_rad, in.friction_rad));
  return in;
}

namespace {

/// On falling ground a flatter blade would leave the ground behind its edge.
double LeastRake_rad(const CuttingInput& in) {
  return kLeastRake_rad + std::max(0.0, -in.slope_rad);
}

double FlattestWedge_rad(const CuttingInput& in) {
  return std::max(in.slope_rad, -in.friction_rad) + 4 * kMargin_rad;
}

/// The steepest rake that leaves room for a plane slip surface before the pole of the equilibrium.
double RakeWithRoom_rad(const CuttingInput& in) {
  return kPi - in.tool_friction_rad - in.friction_rad - kMargin_rad - FlattestWedge_rad(in) -
         kLeastRange_rad;
}

}  // namespace

CuttingForce PlaneCut(const CuttingInput& input) {
  CuttingForce result;
  if (input.depth_m <= 0) return result;
  CuttingInput in = AsUpright(input);
  in.rake_rad = std::max(in.rake_rad, LeastRake_rad(in));
  const double contact_rad = in.rake_rad + in.tool_friction_rad;
  in.rake_rad = std::min(in.rake_rad, std::max(LeastRake_rad(in), RakeWithRoom_rad(in)));
  const double low_rad = FlattestWedge_rad(in);
  const double leans_to = kPi - in.tool_friction_rad - in.friction_rad - kMargin_rad;
  const double high_rad =
      std::max(low_rad + kMargin_rad, std::min(kPi / 2 - kMargin_rad, leans_to - in.rake_rad));
  const Wedges wedges(in);
  result.wedge_rad = WhereLeast([&](double wedge_rad) { return wedges.ForceAt_n(wedge_rad); },
                                low_rad, high_rad, kSections);
  result.wedge_length_m = in.depth_m * wedges.Ahead(std::tan(result.wedge_rad));
  result.total_n = std::max(0.0, wedges.ForceAt_n(result.wedge_rad));
  result.draft_n = result.total_n * std::sin(contact_rad);
  result.vertical_n = result.total_n * std::cos(contact_rad);
  return result;
}

CuttingForce Cut(const CuttingInput& input) {
  CuttingForce result = PlaneCut(input);
  if (input.depth_m <= 0) return result;
  CuttingInput in = AsUpright(input);
  in.rake_rad = std::max(in.rake_rad, LeastRake_rad(in));
  const double curved_n = std::max(0.0, CurvedSlipForce_n(in));
  // At very high friction no spiral has an equilibrium; the force of the plane remains.
  if (!std::isfinite(curved_n)) return result;
  const bool has_room = in.rake_rad <= RakeWithRoom_rad(in);
  result.total_n = has_room ? std::min(result.total_n, curved_n) : curved_n;
  result.draft_n = result.total_n * std::sin(in.rake_rad + in.tool_friction_rad);
  result.vertical_n = result.total_n * std::cos(in.rake_rad + in.tool_friction_rad);
  return result;
}

}  // namespace tera
