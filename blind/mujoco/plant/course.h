#pragma once

#include <functional>
#include <vector>

#include "blind/mujoco/plant/plant_form.h"

namespace tera::blind::mujoco {

/// What the machine is and does at one instant.
struct Instant {
  Vec3 p_WB_m;
  Quat q_WB;
  PerAxis<double> angle_rad{}, rate_radps{};
  std::array<Vec3, kUnits> gyro_radps, accelerometer_mps2;  ///< at sites as they really are
  std::array<Vec3, kReceivers> antenna_m;                   ///< in W
};

/// Levers as they were recorded, each in force until the next.
struct Levers {
  double period_s = 0.02;
  std::vector<PerAxis<double>> rows;
};

/// A drive, without any measurement, a row a step.
struct Course {
  double from_s = 0;  ///< of the first instant
  std::vector<Instant> instants;
  Levers levers;

  /// Nearest instant, within the course.
  const Instant& At(double t_s) const;
};

/// Moves the levers, seeing angles and the place.
using Operator = std::function<PerAxis<double>(double t_s, const Instant& seen)>;

/// From a stand, which takes 1.5 s before t = 0, on to `duration_s`. `messages` is what is random
/// on the bus.
Course Drive(const MachineNumbers& numbers, const PlantForm& form, const Start& start,
             double duration_s, const Operator& someone, const Stream& messages);

/// The levers of another course again.
Operator Replayed(const Levers& levers);

}  // namespace tera::blind::mujoco
