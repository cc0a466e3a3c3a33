#include "soil/tool/curved_slip.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/motion.h"
#include "core/units.h"
#include "soil/tool/golden_section.h"

namespace tera {
namespace {

/// tangent; with less friction the spiral would become a circle
constexpr double kLeastFriction = 1e-6;
constexpr double kLeastTurn_rad = 1e-3;
constexpr double kTurnStep_rad = 15 * kDeg, kWidestTurn_rad = 120.5 * kDeg;
// Exit angle of the spiral of least force. On level ground it exceeds that of Rankine's slip plane
// by a share of the turn; on a slope, a share of the slope is added.
constexpr double kExitPerTurn = 1.0 / 3, kExitPerSlope = 0.6;
constexpr double kAround_rad = 25 * kDeg;  ///< search range around that exit angle

double CrossOf(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// First moment, about the vertical through the pole, of the triangle of the pole and two points.
double Moment_m3(const Vec2& a, const Vec2& b) { return CrossOf(a, b) / 6 * (a.x() + b.x()); }

/// The moment equation of one blade in one soil, prepared for many spirals.
class Spirals {
 public:
  explicit Spirals(const CuttingInput& in)
      : in_(in),
        weight_npm3_(in.density_kgpm3 * kStandardGravity_mps2),
        tan_friction_(std::max(std::tan(in.friction_rad), kLeastFriction)),
        sin_friction_(std::sin(std::atan(tan_friction_))),
        tan_slope_(std::tan(in.slope_rad)),
        up_blade_(-std::cos(in.rake_rad), std::sin(in.rake_rad)),
        push_(std::sin(in.rake_rad + in.tool_friction_rad),
              std::cos(in.rake_rad + in.tool_friction_rad)),
        blade_m_(in.depth_m / (up_blade_.y() - up_blade_.x() * tan_slope_)) {}

  double ForceAt_n(double exit_rad, double turn_rad) const {
    // The radius is perpendicular to the slip surface, tilted back by the friction angle. Points
    // are relative to the pole; moments are per metre of width.
    const double from_rad = exit_rad - turn_rad + in_.friction_rad - kPi / 2;
    const Vec2 from(std::cos(from_rad), std::sin(from_rad));
    const Vec2 to(std::cos(from_rad + turn_rad), std::sin(from_rad + turn_rad));
    const double grows = std::exp(turn_rad * tan_friction_);
    const Vec2 chord = grows * to - from;
    const double climbs = chord.y() - chord.x() * tan_slope_;
    if (climbs <= 0) return std::numeric_limits<double>::infinity();
    const double radius_m = in_.depth_m / climbs;
    const Vec2 edge = radius_m * from, end = radius_m * grows * to;
    const double low_arm_m = CrossOf(edge + blade_m_ / 3 * up_blade_, push_);
    const double mid_arm_m = CrossOf(edge + blade_m_ / 2 * up_blade_, push_);
    if (low_arm_m <= 0 || mid_arm_m <= 0) return std::numeric_limits<double>::infinity();
    const Vec2 lip = edge + blade_m_ * up_blade_;
    const double weight_n =
        weight_npm3_ * (SectorMoment_m3(edge, end) + Moment_m3(end, lip) + Moment_m3(lip, edge));
    const double sector_m2 = (end.squaredNorm() - edge.squaredNorm()) / (4 * tan_friction_);
    const double cohesive_n = 2 * sector_m2 * in_.cohesion_pa;
    const double adhesive_n = in_.adhesion_pa * CrossOf(edge, blade_m_ * up_blade_);
    const double surcharge_n =
        (in_.surcharge_pa + in_.overburden_pa) * 0.5 * (end.x() * end.x() - lip.x() * lip.x());
    const double others_n = cohesive_n + adhesive_n + surcharge_n +
                            FlanksMoment_n(edge, end, sector_m2) +
                            InertiaMoment_n(chord, edge, end, sector_m2);
    return in_.width_m * (weight_n / low_arm_m + others_n / mid_arm_m);
  }

 private:
  /// First moment of the area between spiral and pole: the integral of r^3 cos / 3 over the angle.
  double SectorMoment_m3(const Vec2& edge, const Vec2& end) const {
    const double t = 3 * tan_friction_;
    const auto integral = [&](const Vec2& p) { return p.squaredNorm() * (t * p.x() + p.y()); };
    return (integral(end) - integral(edge)) / (3 * (t * t + 1));
  }

  /// Moment of the shear on both flanks of the soil ahead. It acts near the centre of the triangle
  /// over the chord, along the motion of the soil there.
  double FlanksMoment_n(const Vec2& edge, const Vec2& end, double sector_m2) const {
    const Vec2 above = edge + in_.depth_m * Vec2::UnitY();
    const double side_m2 =
        std::max(0.0, sector_m2 + 0.5 * (CrossOf(end, above) + CrossOf(above, edge)));
    // coefficient of earth pressure at rest (Jaky)
    const double at_rest = 1 - std::sin(in_.friction_rad);
    const double normal_pa = at_rest * (weight_npm3_ * in_.depth_m / 3 + in_.overburden_pa);
    const double shear_n = side_m2 * (in_.cohesion_pa + normal_pa * tan_friction_) +
                           in_.flank_above_npm * std::max(0.0, end.x() - edge.x());
    const double arm_m = (edge + above + end).norm() / 3 * std::cos(in_.friction_rad);
    return 2 * in_.flank_share * shear_n * arm_m / in_.width_m;
  }

  /// Moment of the inertia of soil that is accelerated along the chord.
  double InertiaMoment_n(const Vec2& chord, const Vec2& edge, const Vec2& end,
                         double sector_m2) const {
    const double speed2 = in_.speed_mps * in_.speed_mps;
    const double inertia_npm = in_.density_kgpm3 * speed2 * in_.depth_m * in_.depth_m /
                               CrossOf(chord.normalized(), blade_m_ * up_blade_);
    const double length_m = (end.norm() - edge.norm()) / sin_friction_;
    return inertia_npm * 2 * sector_m2 / length_m;
  }

  const CuttingInput& in_;
  double weight_npm3_, tan_friction_, sin_friction_, tan_slope_;
  Vec2 up_blade_, push_;  ///< unit vectors: from the edge up the blade, and along P
  double blade_m_;        ///< length of the blade in the ground
};

}  // namespace

double CurvedSlipForceAt_n(const CuttingInput& in, double exit_rad, double turn_rad) {
  return Spirals(in).ForceAt_n(exit_rad, turn_rad);
}

double CurvedSlipForce_n(const CuttingInput& in) {
  const Spirals spirals(in);
  const double rankine_rad = kPi / 4 - in.friction_rad / 2 + kExitPerSlope * in.slope_rad;
  const auto force_n = [&](double steeper_rad, double turn_rad) {
    return spirals.ForceAt_n(rankine_rad + steeper_rad + kExitPerTurn * turn_rad, turn_rad);
  };
  // A coarse search first: too little or too much turn gives no equilibrium.
  double turn_rad = kLeastTurn_rad, least_n = force_n(0, turn_rad);
  for (double turn = kTurnStep_rad; turn <= kWidestTurn_rad; turn += kTurnStep_rad) {
    const double at_turn_n = force_n(0, turn);
    if (at_turn_n < least_n) least_n = at_turn_n, turn_rad = turn;
  }
  const double steeper_rad = WhereLeast([&](double steeper) { return force_n(steeper, turn_rad); },
                                        -kAround_rad, kAround_rad, 8);
  turn_rad =
      WhereLeast([&](double turn) { return force_n(steeper_rad, turn); },
                 std::max(kLeastTurn_rad, turn_rad - kTurnStep_rad), turn_rad + kTurnStep_rad, 7);
  return std::min(least_n, force_n(steeper_rad, turn_rad));
}

}  // namespace tera
