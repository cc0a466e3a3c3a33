#include "physics/gear_motor.h"

#include <algorithm>
#include <cmath>

namespace tera {

GearTorques DriveGear(const GearDrive& drive, const AxisDrive& target, double rate_radps,
                      double load_nm, double dt_s) {
  const double inertia_kgm2 = drive.inertia_kgm2, most_nm = drive.max_torque_nm;
  const auto motor_nm = [&](double friction_nm) {
    const double needed_nm =
        inertia_kgm2 * (target.rate_radps - rate_radps) / dt_s + (load_nm - friction_nm);
    return std::clamp(needed_nm, -most_nm, most_nm);
  };
  if (!target.friction.any()) return {motor_nm(0), 0};
  const auto end_radps = [&](double friction_nm) {
    return rate_radps + (motor_nm(friction_nm) - (load_nm - friction_nm)) * dt_s / inertia_kgm2;
  };
  const double up = target.friction.against_negative_nm;
  const double down = -target.friction.against_positive_nm;
  if (end_radps(up) < 0) return {motor_nm(up), up};
  if (end_radps(down) > 0) return {motor_nm(down), down};
  const double held_nm = load_nm - inertia_kgm2 * rate_radps / dt_s;
  const double motor =
      target.rate_radps == 0 ? motor_nm(0) : std::copysign(most_nm, target.rate_radps);
  return {motor, held_nm - motor};
}

}  // namespace tera
