#include "physics/actuation/gear_motor.h"

#include <algorithm>
#include <cmath>

namespace tera {

GearTorques DriveGear(const GearDrive& drive, const AxisDrive& target, double rate_radps,
                      double load_nm, double dt_s) {
  const double inertia_kgm2 = drive.inertia_kgm2, most_nm = drive.max_torque_nm;
  const double damped_kgm2 = inertia_kgm2 + target.friction.viscous_nmsprad * dt_s;
  const auto motor_nm = [&](double friction_nm) {
    const double needed_nm = (damped_kgm2 * target.rate_radps - inertia_kgm2 * rate_radps) / dt_s +
                             (load_nm - friction_nm);
    return std::clamp(needed_nm, -most_nm, most_nm);
  };
  if (!target.friction.any()) return {motor_nm(0), 0};
  const auto end_radps = [&](double friction_nm) {
    return (inertia_kgm2 * rate_radps + (motor_nm(friction_nm) - (load_nm - friction_nm)) * dt_s) /
           damped_kgm2;
  };
  const auto moving = [&](double friction_nm) {
    const double viscous_nm = target.friction.viscous_nmsprad * end_radps(friction_nm);
    return GearTorques{motor_nm(friction_nm), friction_nm - viscous_nm};
  };
  const double up = target.friction.against_negative_nm;
  const double down = -target.friction.against_positive_nm;
  if (end_radps(up) < 0) return moving(up);
  if (end_radps(down) > 0) return moving(down);
  const double held_nm = load_nm - inertia_kgm2 * rate_radps / dt_s;
  const double motor =
      target.rate_radps == 0 ? motor_nm(0) : std::copysign(most_nm, target.rate_radps);
  return {motor, held_nm - motor};
}

}  // namespace tera
