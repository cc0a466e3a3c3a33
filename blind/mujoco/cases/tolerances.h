#pragma once

#include "blind/mujoco/cases/draws.h"
#include "blind/mujoco/plant/plant_form.h"
#include "blind/mujoco/sensors/sensors_form.h"

namespace tera::blind::mujoco {

/// Actual forms of a machine and its sensors.
struct Forms {
  PlantForm plant;
  SensorsForm sensors;
};

/// The owner's expected deviations. Effects are drawn as multiples of these.
struct Tolerances {
  double rate = 0.06;       ///< at full lever, or gain by direction or angle
  double dead_band = 0.02;  ///< or dry friction, share of full lever
  double late_s = 0.04;     ///< delays and lags together, from lever to encoder; of stamps
  double travel = 0.02, tracks_apart = 0.005, gauge = 0.05;
  double zero_rad = 0.003;                               ///< of an encoder
  double gyro_radps = 0.002, accelerometer_mps2 = 0.04;  ///< bias
  double mount_rad = 0.008, antenna_m = 0.025, datum_m = 0.04;
};
inline constexpr Tolerances kTolerances{};

/// A machine without faults: its oil, and random deviations of all numbers within the tolerances.
Forms DrawWithinTolerances(const MachineNumbers& numbers, Draws* draws);

}  // namespace tera::blind::mujoco
