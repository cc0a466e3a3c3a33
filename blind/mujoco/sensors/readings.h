#pragma once

#include <vector>

#include "blind/mujoco/plant/course.h"
#include "blind/mujoco/sensors/sensors_form.h"

namespace tera::blind::mujoco {

inline constexpr double kUnitPeriod_s = 0.01, kEncoderPeriod_s = 0.02, kReceiverPeriod_s = 0.1;

/// Noise-free sensor readings, by true time.
class Readings {
 public:
  Readings(const MachineNumbers& numbers, const Course& course, const SensorsForm& form);

  /// Angular rate and specific force: mean over the period that ends at `t_s`, after a second-order
  /// low pass at 35 Hz, as in the data sheet.
  std::array<double, 6> Unit(std::size_t unit, double t_s) const;
  double Angle_rad(std::size_t axis, double t_s) const;
  double Rate_radps(std::size_t axis, double t_s) const;
  /// East, north, up.
  Vec3 Receiver_m(std::size_t receiver, double t_s) const;

 private:
  /// Vector from an antenna to the arm's pin, in B.
  Vec3 ToArm_m(std::size_t receiver, const Instant& at) const;
  Vec3 Reflected_m(std::size_t receiver, const Instant& at) const;
  Vec3 Shaded_m(std::size_t receiver, const Instant& at) const;

  const MachineNumbers& numbers_;
  const Course& course_;
  const SensorsForm& form_;
  /// Cumulative sums over the steps of the low pass's output.
  std::array<std::vector<std::array<double, 6>>, kUnits> sums_;
};

}  // namespace tera::blind::mujoco
