#include "soil/track/rolling.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

/// c1 and c2 of the peak of the stress
constexpr double kPeakAtNoSlip = 0.40, kPeakWithSlip = 0.15;
constexpr double kDugBySlip = 1.3, kSlipToDig = 0.42;  ///< constants of g for slip
constexpr double kDugBySkid = 3.5;
constexpr double kDugOverBearing = 6;     ///< ratio f / g
constexpr double kGrouserShare = 0.5;     ///< share of the grouser height that is added to K
constexpr double kLeastEntry_rad = 1e-3;  ///< a smaller entry angle means rigid ground
/// least share, for ground behind the axle of a rolling wheel
constexpr double kLeastShare = 1e-3;

}  // namespace

double Rolling::BearingShare(const SoilType& soil, double grouser_m, double deep_m) const {
  const double x = slip / kSlipToDig;
  const double g = -kDugBySlip * std::expm1(-x * x) + kDugBySkid * skid * skid;
  if (g <= 0 || deep_m <= 0) return 1;
  const double dug_m = g * (soil.shear_modulus_m + kGrouserShare * grouser_m);
  const double most = kDugOverBearing * g;
  return 1 - std::min(dug_m / deep_m, most / (1 + most));
}

double Rolling::ShareAt(const Place& place, double entry_rad, double bearing_share) const {
  const double plastic = place.pressed_m / (place.pressed_m + place.pen_m);
  const double trails = 0.5 * (std::abs(aside) - aside * place.across);
  const double across_share = 1 - plastic * trails;
  const double angle_rad = place.angle_rad;
  const double peak_rad = (kPeakAtNoSlip + kPeakWithSlip * slip) * entry_rad;
  if (angle_rad >= peak_rad || entry_rad < kLeastEntry_rad) return across_share * bearing_share;
  double behind_peak = 0;
  if (angle_rad > 0) {
    const double mirrored_rad = entry_rad - angle_rad / peak_rad * (entry_rad - peak_rad);
    behind_peak = (std::cos(mirrored_rad) - std::cos(entry_rad)) /
                  (std::cos(angle_rad) - std::cos(entry_rad));
  }
  const double along_share = 1 - std::abs(rolled) * plastic * (1 - behind_peak);
  return std::max(kLeastShare, across_share * along_share * bearing_share);
}

void RollingMemory::Advance(double forward_m, double aside_m, double shoe_m, double length_m) {
  if (length_m <= 0) return;
  const double way_m = std::hypot(forward_m, aside_m);
  const bool against = forward_m * shoe_m < 0;  // the rim turns against the motion
  const double slip_m = against ? -(way_m + std::abs(shoe_m)) : std::abs(shoe_m) - way_m;
  slipped_ = std::max(-1.0, (slipped_ * length_m + slip_m) / (length_m + way_m));
  const double moved_m = std::abs(shoe_m) > std::abs(forward_m) ? shoe_m : forward_m;
  rolled_ = std::clamp(rolled_ + moved_m / length_m, -1.0, 1.0);
  aside_ = (aside_ * length_m + aside_m) / (length_m + way_m);
}

Rolling RollingMemory::State() const {
  return {.slip = slipped_ > 0 ? slipped_ / (1 + slipped_) : 0,
          .skid = std::max(0.0, -slipped_),
          .rolled = rolled_,
          .aside = aside_};
}

}  // namespace tera
