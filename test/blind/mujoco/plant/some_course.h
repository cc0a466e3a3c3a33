#pragma once

#include "blind/mujoco/plant/course.h"
#include "blind/mujoco/plant/model.h"

/// The 4 t machine and its drive in the tests of the plant and its concealed effects.

namespace tera::blind::mujoco {

inline const MachineNumbers& FourTons() {
  static const MachineNumbers numbers =
      MachineNumbers::Read("examples/prove/excavator4t.yaml", "examples/prove/rig4t.yaml");
  return numbers;
}

inline Start SomeStart() {
  Start start;
  start.yaw_rad = 0.7;
  start.joints_rad = {0.2, 0.35, -1.4, -0.3};
  return start;
}

inline Course DriveBy(const Operator& someone, double duration_s, const PlantForm& form = {},
                      const Start& start = SomeStart()) {
  return Drive(FourTons(), form, start, duration_s, someone, Stream(1, "messages"));
}

}  // namespace tera::blind::mujoco
