#include "soil/tool/slip_ahead.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "core/motion.h"
#include "core/units.h"
#include "soil/tool/golden_section.h"

namespace tera {
namespace {

constexpr int kLast = GroundAhead::kPlaces - 1;
constexpr double kNever = std::numeric_limits<double>::infinity();
/// tangent; with less friction the spiral would become a circle
constexpr double kLeastFrictionAhead = 1e-6;
constexpr double kLeastSine = 0.02;  ///< least lifting component of P on a wedge
constexpr double kTurnStepAhead_rad = 15 * kDeg;
constexpr double kFlattestRake_rad = 5 * kDeg;
constexpr int kMostTurns = 8;
constexpr double kLeastMotion = 1e-9;

double CrossProduct(const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The soil between a slip plane and the ground, per metre of width.
struct Lifted {
  double end_m = 0;       ///< x at which it ends
  double slope = 0;       ///< slope of the plane
  double weight_npm = 0;  ///< without the soil on the blade
  double moment_n = 0;    ///< moment of that weight about the edge
  double firm_m = 0;      ///< horizontal length of the plane in firm soil
  double flank_npm = 0;   ///< shear on one flank
};

/// All slip surfaces in front of one blade.
class SlipAhead {
 public:
  SlipAhead(const CuttingInput& in, const GroundAhead& ground, const SoilAhead& soil)
      : in_(in),
        ground_(ground),
        soil_(soil),
        firm_npm3_(soil.firm_density_kgpm3 * kStandardGravity_mps2),
        loose_npm3_(soil.loose_density_kgpm3 * kStandardGravity_mps2),
        mean_npm3_(in.density_kgpm3 * kStandardGravity_mps2),
        tan_friction_(std::max(std::tan(in.friction_rad), kLeastFrictionAhead)),
        cos_friction_(1 / std::sqrt(1 + tan_friction_ * tan_friction_)),
        at_rest_(1 - tan_friction_ * cos_friction_),  // earth pressure coefficient (Jaky)
        up_blade_(-std::cos(in.rake_rad), std::sin(in.rake_rad)),
        push_(std::sin(in.rake_rad + in.tool_friction_rad),
              std::cos(in.rake_rad + in.tool_friction_rad)) {
    FindSums();
    FindOnBlade();
    FindSliding();
  }

  CuttingForce Least();

 private:
  /// Integrals over the ground from the edge on: of the height, of x times the height, of the
  /// squared height.
  struct Sums {
    double m2 = 0, x_m3 = 0, square_m3 = 0;
  };
  struct Firm {
    double m2 = 0, length_m = 0;
  };
  /// Turn and growth of a spiral.
  struct Turn {
    double rad, grows;
    std::complex<double> pole;  ///< for a spiral that ends at 1
  };
  void FindSums();
  void FindOnBlade();
  void FindSliding();
  Sums SumsTo(double end) const;
  Firm FirmAbove(double slope, double end) const;
  Turn TurnOf(double rad) const {
    const double grows = std::exp(rad * tan_friction_);
    return {rad, grows, 1.0 / (1.0 - std::polar(grows, rad))};
  }
  Lifted Above(double slope, double end) const;
  /// x at the fractional index `s` of the samples, by linear interpolation.
  double XAt_m(double s) const { return Between(ground_.x_m, s); }
  static double Between(const std::array<double, GroundAhead::kPlaces>& of, double s) {
    const int k = std::min(static_cast<int>(s), kLast - 1);
    return of[k] + (s - k) * (of[k + 1] - of[k]);
  }
  double SlopeTo(double s) const { return Between(ground_.top_m, s) / XAt_m(s); }
  double PlaneForce_npm(const Lifted& lifted, double pushed_npm) const;
  double SpiralForce_npm(const Lifted& lifted, const Turn& turn) const;
  double CarriedOver_npm(double end_m) const {
    const double over_m = end_m - in_soil_m_ * up_blade_.x();
    return soil_.carried_npm * std::min(1.0, over_m / soil_.carried_over_m);
  }
  void TryPlanes();
  void TrySliding();
  void TrySpirals();
  void Take(double force_npm, const Lifted& lifted, double reach_m) {
    if (force_npm >= least_npm_) return;
    least_npm_ = force_npm;
    slope_ = lifted.slope;
    reach_m_ = reach_m;
  }

  const CuttingInput& in_;
  const GroundAhead& ground_;
  const SoilAhead& soil_;
  double firm_npm3_, loose_npm3_, mean_npm3_, tan_friction_, cos_friction_, at_rest_;
  Vec2 up_blade_, push_;  ///< unit vectors: from the edge up the blade, and along P
  double in_soil_m_ = 0;  ///< length of the blade in the ground
  /// weight behind the edge, and its moment about the edge
  double on_blade_npm_ = 0, on_blade_n_ = 0;
  std::array<Sums, GroundAhead::kPlaces> sums_;
  int firm_to_ = 0;  ///< index of the last sample before the first loose soil
  /// Force that slides the loose soil from each sample on, and x at which the slide ends.
  std::array<double, GroundAhead::kPlaces> slide_npm_{}, slide_to_m_{};
  std::array<Lifted, GroundAhead::kPlaces> to_;  ///< planes that leave the ground at each sample
  /// the plane to this sample does not leave the ground before it
  std::array<bool, GroundAhead::kPlaces> is_seen_{};
  int nearest_best_ = 0;
  double least_npm_ = kNever, slope_ = 0, reach_m_ = 0;
};

void SlipAhead::FindSums() {
  for (int k = 1; k <= kLast; ++k) sums_[k] = SumsTo(k - 1e-12 * k);
  while (firm_to_ < kLast && ground_.firm_m[firm_to_] >= ground_.top_m[firm_to_]) ++firm_to_;
}

/// Weight of the soil between blade and surface. Behind the edge the surface continues with the
/// slope ahead.
void SlipAhead::FindOnBlade() {
  const double depth_m = ground_.depth_m();
  const double slope = (ground_.top_m[1] - depth_m) / ground_.x_m[1];
  const double closes = up_blade_.y() - up_blade_.x() * slope;
  in_soil_m_ = closes > 0 ? std::min(depth_m / closes, soil_.blade_m) : soil_.blade_m;
  const double back_m = -in_soil_m_ * up_blade_.x();
  const double end_m = std::max(0.0, depth_m - in_soil_m_ * closes);
  on_blade_npm_ = mean_npm3_ * 0.5 * back_m * (depth_m + end_m);
  on_blade_n_ = -mean_npm3_ * back_m * back_m * (depth_m + 2 * end_m) / 6;
}

/// From the farthest sample backwards: loose soil slides on the firm soil, or fails as Rankine's
/// wedge, whichever takes less force.
void SlipAhead::FindSliding() {
  const double k_p = std::pow((1 + tan_friction_ * cos_friction_) / cos_friction_, 2);
  for (int k = kLast; k >= 0; --k) {
    const double loose_m = std::max(0.0, ground_.top_m[k] - ground_.firm_m[k]);
    slide_npm_[k] = 0.5 * loose_npm3_ * k_p * loose_m * loose_m;
    slide_to_m_[k] = ground_.x_m[k] + loose_m * (1 + tan_friction_ * cos_friction_) / cos_friction_;
    if (k == kLast) continue;
    const double dx_m = ground_.x_m[k + 1] - ground_.x_m[k];
    const double rise = (ground_.firm_m[k + 1] - ground_.firm_m[k]) / dx_m;
    const double beyond_m = std::max(0.0, ground_.top_m[k + 1] - ground_.firm_m[k + 1]);
    const double stays = 1 - tan_friction_ * rise;
    if (stays <= kLeastSine) continue;
    const double slide_npm =
        slide_npm_[k + 1] + std::max(0.0, loose_npm3_ * 0.5 * (loose_m + beyond_m) * dx_m *
                                              (tan_friction_ + rise) / stays);
    if (slide_npm >= slide_npm_[k]) continue;
    slide_npm_[k] = slide_npm;
    slide_to_m_[k] = slide_to_m_[k + 1];
  }
}

/// Integrals up to the fractional index `end`.
SlipAhead::Sums SlipAhead::SumsTo(double end) const {
  const int k = std::min(static_cast<int>(end), kLast - 1);
  const double from_m = ground_.x_m[k], to_m = XAt_m(end), dx_m = to_m - from_m;
  const double a = ground_.top_m[k], b = Between(ground_.top_m, end);
  Sums sums = sums_[k];
  sums.m2 += 0.5 * dx_m * (a + b);
  sums.x_m3 += dx_m * (a * (2 * from_m + to_m) + b * (from_m + 2 * to_m)) / 6;
  sums.square_m3 += dx_m * (a * a + a * b + b * b) / 3;
  return sums;
}

/// Firm soil above a plane up to the fractional index `end`: area and horizontal length.
SlipAhead::Firm SlipAhead::FirmAbove(double slope, double end) const {
  Firm firm;
  double x_m = 0, at_m = ground_.firm_m[0];
  for (int k = 1; k < end + 1; ++k) {
    const double s = std::min<double>(k, end);
    const double to_m = XAt_m(s), next_m = Between(ground_.firm_m, s) - slope * to_m;
    const double stands_m = std::max(0.0, at_m) + std::max(0.0, next_m);
    const double share = stands_m / std::max(std::abs(at_m) + std::abs(next_m), kLeastMotion);
    firm.length_m += share * (to_m - x_m);
    firm.m2 += 0.5 * stands_m * share * (to_m - x_m);
    x_m = to_m, at_m = next_m;
  }
  return firm;
}

/// Soil above a plane up to the fractional index `end`.
Lifted SlipAhead::Above(double slope, double end) const {
  Lifted lifted{.end_m = XAt_m(end), .slope = slope};
  const double x2 = lifted.end_m * lifted.end_m, x3 = x2 * lifted.end_m;
  const Sums sums = SumsTo(end);
  const double area_m2 = std::max(0.0, sums.m2 - 0.5 * slope * x2);
  const double area_m3 = sums.x_m3 - slope * x3 / 3;
  const double square_m3 =
      std::max(0.0, sums.square_m3 - 2 * slope * sums.x_m3 + slope * slope * x3 / 3);
  const Firm firm = end <= firm_to_ ? Firm{area_m2, lifted.end_m} : FirmAbove(slope, end);
  lifted.weight_npm = loose_npm3_ * area_m2 + (firm_npm3_ - loose_npm3_) * firm.m2;
  lifted.moment_n = lifted.weight_npm * area_m3 / std::max(area_m2, kLeastMotion);
  lifted.firm_m = firm.length_m;
  lifted.flank_npm =
      soil_.firm_cohesion_pa * firm.m2 + at_rest_ * tan_friction_ * 0.5 * mean_npm3_ * square_m3;
  return lifted;
}

/// P for a wedge on a plane. `pushed_npm` is the resistance of the soil ahead of the wedge.
double SlipAhead::PlaneForce_npm(const Lifted& lifted, double pushed_npm) const {
  // Components along the normal to the reaction of the slip plane, which is tilted back by the
  // friction angle.
  const double length = std::sqrt(1 + lifted.slope * lifted.slope);
  const double up = (lifted.slope + tan_friction_) * cos_friction_ / length;
  const double ahead = (1 - lifted.slope * tan_friction_) * cos_friction_ / length;
  const double lifts = push_.x() * ahead + push_.y() * up;
  if (lifts < kLeastSine) return kNever;
  const double weight_npm = lifted.weight_npm + on_blade_npm_ + CarriedOver_npm(lifted.end_m) +
                            in_.surcharge_pa * (lifted.end_m - in_soil_m_ * up_blade_.x());
  const double shear_npm = soil_.firm_cohesion_pa * lifted.firm_m * length +
                           2 * in_.flank_share * lifted.flank_npm / in_.width_m;
  const double adhesion_npm =
      in_.adhesion_pa * in_soil_m_ * (up_blade_.y() * up + up_blade_.x() * ahead);
  // Soil enters the slip plane at the speed of the blade and leaves along it.
  const double lean = up_blade_.y() - lifted.slope * up_blade_.x();
  const double inertia_npm = in_.density_kgpm3 * in_.speed_mps * in_.speed_mps * ground_.depth_m() *
                             up_blade_.y() * length * cos_friction_ / std::max(lean, kLeastSine);
  return std::max(0.0, weight_npm * up + shear_npm * cos_friction_ + pushed_npm * ahead +
                           adhesion_npm + inertia_npm) /
         lifts;
}

/// P for a spiral from the edge to the end of a plane.
double SlipAhead::SpiralForce_npm(const Lifted& lifted, const Turn& turn) const {
  const Vec2 end(lifted.end_m, lifted.slope * lifted.end_m);
  // In complex numbers: end - pole is edge - pole, turned and multiplied by `grows`.
  const std::complex<double> pole_c = std::complex<double>(end.x(), end.y()) * turn.pole;
  const Vec2 from(-pole_c.real(), -pole_c.imag()), to = from + end;
  const double low_arm_m = CrossProduct(from + in_soil_m_ / 3 * up_blade_, push_);
  const double mid_arm_m = CrossProduct(from + in_soil_m_ / 2 * up_blade_, push_);
  if (low_arm_m <= 0 || mid_arm_m <= 0) return kNever;
  const double sector_m2 = (to.squaredNorm() - from.squaredNorm()) / (4 * tan_friction_);
  const double t = 3 * tan_friction_;
  const auto integral = [&](const Vec2& p) { return p.squaredNorm() * (t * p.x() + p.y()); };
  const double bulge_m2 = sector_m2 - 0.5 * CrossProduct(from, to);
  const double bulge_m3 = (integral(to) - integral(from)) / (3 * (t * t + 1)) -
                          CrossProduct(from, to) / 6 * (from.x() + to.x());
  const double firm = lifted.firm_m / lifted.end_m;
  const double below_npm3 = firm * firm_npm3_ + (1 - firm) * loose_npm3_;
  const double weight_n = lifted.moment_n + on_blade_n_ +
                          (lifted.weight_npm + on_blade_npm_) * from.x() + below_npm3 * bulge_m3;
  const double cohesive_n = 2 * sector_m2 * firm * soil_.firm_cohesion_pa;
  const double adhesive_n = in_.adhesion_pa * CrossProduct(from, in_soil_m_ * up_blade_);
  const double lip_m = from.x() + in_soil_m_ * up_blade_.x();
  const double surcharge_n = 0.5 * in_.surcharge_pa * (to.x() * to.x() - lip_m * lip_m) +
                             CarriedOver_npm(lifted.end_m) * 0.5 * (to.x() + lip_m);
  const Vec2 above = from + ground_.depth_m() * Vec2::UnitY();
  const double flank_npm = lifted.flank_npm + bulge_m2 * (firm * soil_.firm_cohesion_pa +
                                                          at_rest_ * tan_friction_ * below_npm3 *
                                                              0.5 * ground_.depth_m());
  const double flank_arm_m = (from + above + to).norm() / 3 * cos_friction_;
  const double flanks_n = 2 * in_.flank_share * flank_npm * flank_arm_m / in_.width_m;
  const double length_m = (to.norm() - from.norm()) / (tan_friction_ * cos_friction_);
  const double inertia_n = in_.density_kgpm3 * in_.speed_mps * in_.speed_mps * ground_.depth_m() *
                           ground_.depth_m() * end.norm() /
                           std::max(CrossProduct(end, in_soil_m_ * up_blade_), kLeastMotion) * 2 *
                           sector_m2 / length_m;
  return std::max(0.0,
                  weight_n / low_arm_m +
                      (cohesive_n + adhesive_n + surcharge_n + flanks_n + inertia_n) / mid_arm_m);
}

void SlipAhead::TryPlanes() {
  double flattest = kNever, least_npm = kNever;
  for (int k = 1; k <= kLast; ++k) {
    const double slope = SlopeTo(k);
    is_seen_[k] = slope <= flattest;
    if (!is_seen_[k]) continue;
    flattest = slope;
    to_[k] = Above(slope, k);
    const double force_npm = PlaneForce_npm(to_[k], 0);
    Take(force_npm, to_[k], to_[k].end_m);
    if (force_npm < least_npm) least_npm = force_npm, nearest_best_ = k;
  }
  if (nearest_best_ == 0) return;
  const double s = WhereLeast([&](double at) { return PlaneForce_npm(Above(SlopeTo(at), at), 0); },
                              std::max(1.0, nearest_best_ - 1.0),
                              std::min<double>(kLast, nearest_best_ + 1.0), 5);
  const Lifted lifted = Above(SlopeTo(s), s);
  Take(PlaneForce_npm(lifted, 0), lifted, lifted.end_m);
}

void SlipAhead::TrySliding() {
  for (int k = 1; k <= kLast; ++k) {
    if (ground_.top_m[k] - ground_.firm_m[k] <= 0) continue;
    const double slope = ground_.firm_m[k] / ground_.x_m[k];
    const Lifted lifted = Above(slope, k);
    Take(PlaneForce_npm(lifted, slide_npm_[k]), lifted, slide_to_m_[k]);
    if (ground_.top_m[k] <= slope * ground_.x_m[k]) break;
  }
}

void SlipAhead::TrySpirals() {
  int k = nearest_best_ > 0 ? nearest_best_ : kLast / 2;
  double least_npm = kNever, turn_rad = 0;
  int exit = 0;
  const auto force_npm = [&](int at, const Turn& turn) {
    return at >= 1 && at <= kLast && is_seen_[at] ? SpiralForce_npm(to_[at], turn) : kNever;
  };
  for (int t = 1; t <= kMostTurns; ++t) {
    const Turn turn = TurnOf(t * kTurnStepAhead_rad);
    double here = force_npm(k, turn);
    for (int at = 1; at <= kLast && !std::isfinite(here); ++at) here = force_npm(k = at, turn);
    for (const int step : {1, -1}) {
      for (double next; (next = force_npm(k + step, turn)) < here; k += step) here = next;
    }
    if (here > least_npm && std::isfinite(here)) break;
    if (here < least_npm) least_npm = here, turn_rad = turn.rad, exit = k;
  }
  if (exit == 0) return;
  turn_rad = WhereLeast([&](double rad) { return force_npm(exit, TurnOf(rad)); },
                        turn_rad - 0.9 * kTurnStepAhead_rad, turn_rad + kTurnStepAhead_rad, 5);
  const Turn turn = TurnOf(turn_rad);
  const double s =
      WhereLeast([&](double at) { return SpiralForce_npm(Above(SlopeTo(at), at), turn); },
                 std::max(1.0, exit - 1.0), std::min<double>(kLast, exit + 1.0), 4);
  const Lifted lifted = Above(SlopeTo(s), s);
  Take(SpiralForce_npm(lifted, turn), lifted, lifted.end_m);
  Take(force_npm(exit, turn), to_[exit], to_[exit].end_m);
}

CuttingForce SlipAhead::Least() {
  TryPlanes();
  TrySliding();
  TrySpirals();
  CuttingForce force;
  // At very high friction no surface has an equilibrium; the force on level ground is used.
  if (!std::isfinite(least_npm_)) return Cut(in_);
  force.total_n = least_npm_ * in_.width_m;
  force.draft_n = force.total_n * push_.x();
  force.vertical_n = force.total_n * push_.y();
  force.wedge_rad = std::atan(slope_);
  force.wedge_length_m = reach_m_;
  return force;
}

}  // namespace

CuttingForce CutAhead(const CuttingInput& input, const GroundAhead& ground, const SoilAhead& soil) {
  if (ground.depth_m() <= 0) return {};
  CuttingInput in = AsUpright(input);
  in.rake_rad = std::max(in.rake_rad, kFlattestRake_rad);
  return SlipAhead(in, ground, soil).Least();
}

}  // namespace tera
