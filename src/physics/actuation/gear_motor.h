#pragma once

#include "physics/actuation/actuation.h"
#include "physics/description/machine.h"

namespace tera {

/// Torques of the motor and of friction on a running gear over a step.
struct GearTorques {
  double motor_nm = 0, friction_nm = 0;
};

/// Motor and friction torque of a running gear that turns at `rate_radps` against `load_nm`.
///
/// Model   The rate at the end of the step is v = v0 + (motor + friction - c v - load) dt / I with
///         viscous friction c. It equals the target as far as the motor's torque allows. Dry
///         friction opposes v, or holds v = 0, within its limits. The sum of motor and dry friction
///         decreases with v, with steps at 0 and at the target, so that the solution is unique.
GearTorques DriveGear(const GearDrive& drive, const AxisDrive& target, double rate_radps,
                      double load_nm, double dt_s);

}  // namespace tera
