#include "sensors/lidar/range_equation.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/units.h"

namespace tera {

void Serialize(ModelArchive* archive, LidarBeam* m) {
  constexpr double kRadPerMrad = 1e-3, kMetresPerMm = 1e-3, kSecondsPerNs = 1e-9;
  archive->Visit("divergence_mrad", &m->divergence_rad, Between(0, 50, "mrad"), kRadPerMrad);
  archive->Check(
      m->divergence_rad >= 1e-5, "divergence_mrad",
      {FaultKind::kOutOfRange,
       "the beam has no width; need 0.01 to 50 mrad, the full angle at half power, or no "
       "beam at all for a thin ray"});
  archive->Visit("aperture_mm", &m->aperture_m, Between(0.1, 200, "mm"), kMetresPerMm);
  archive->Visit("sub_rays", &m->sub_rays, Between(1, 7, ""));
  archive->Check(m->sub_rays == 1 || m->sub_rays == 7, "sub_rays",
                 {FaultKind::kOutOfRange, "need 1 or 7"});
  archive->Visit("pulse_ns", &m->pulse_s, Between(0.1, 100, "ns"), kSecondsPerNs);
  archive->Visit("returns", &m->returns, Between(1, 3, ""));
  archive->Visit("pick", &m->pick, {"strongest", "first", "last"});
}

double RangeEquation::Least(double range_m, double near_m) const {
  if (dark_range_m_ <= 0) return 0;
  if (range_m > dark_range_m_ && bright_exponent_ > 2) {
    return kDarkTarget * std::pow(range_m / dark_range_m_, bright_exponent_);
  }
  const double of_dark_m = dark_range_m_ + near_m;
  const double per_m2 = kDarkTarget / (of_dark_m * of_dark_m);
  const double r_m = range_m + near_m;
  return per_m2 * r_m * r_m;
}

double RangeEquation::Reach_m(double reflectance) const {
  if (dark_range_m_ <= 0) return std::numeric_limits<double>::infinity();
  const double ratio = reflectance / kDarkTarget;
  if (ratio > 1 && bright_exponent_ > 2) {
    return dark_range_m_ * std::pow(ratio, 1 / bright_exponent_);
  }
  return std::max(0.0, (dark_range_m_ + surface_near_m_) * std::sqrt(ratio) - surface_near_m_);
}

double RangeEquation::BeamArea_m2(double range_m) const {
  const double diameter_m = aperture_m_ + divergence_rad_ * range_m;
  return 0.25 * kPi * diameter_m * diameter_m;
}

}  // namespace tera
