#pragma once

#include <functional>
#include <vector>

#include "blind/mujoco/plant/plant_form.h"

namespace tera::blind::mujoco {

/// State of the machine at one instant.
struct Instant {
  Vec3 p_WB_m;
  Quat q_WB;
  PerAxis<double> angle_rad{}, rate_radps{};
  std::array<Vec3, kUnits> gyro_radps, accelerometer_mps2;  ///< at the actual mounts
  std::array<Vec3, kReceivers> antenna_m;                   ///< in W
};

/// Recorded levers, each in force until the next.
struct Levers {
  double period_s = 0.02;
  std::vector<PerAxis<double>> rows;
};

/// A drive without measurement, one row for each step.
struct Course {
  double from_s = 0;  ///< time of the first instant
  std::vector<Instant> instants;
  Levers levers;

  /// Nearest instant, within the course.
  const Instant& At(double t_s) const;
};

/// Gives levers from the observed angles and position.
using Operator = std::function<PerAxis<double>(double t_s, const Instant& seen)>;

/// Drives from rest, which begins 1.5 s before t = 0, to `duration_s`. `messages` is the random
/// stream of the bus.
Course Drive(const MachineNumbers& numbers, const PlantForm& form, const Start& start,
             double duration_s, const Operator& someone, const Stream& messages);

/// Repeats the levers of another course.
Operator Replayed(const Levers& levers);

}  // namespace tera::blind::mujoco
