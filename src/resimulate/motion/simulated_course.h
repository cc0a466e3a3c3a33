#pragma once

#include <cstddef>
#include <vector>

#include "core/motion.h"
#include "core/time.h"

namespace tera {

/// Motion of one machine in a simulation of its whole scenario, at equal time steps.
///
/// Frames  W of the scenario; B root link. Axes are the joints, then the running gears, in the
///         order of the model.
/// Model   linear interpolation between steps.
struct SimulatedCourse {
  struct Step {
    std::vector<double> position_rad, rate_radps;  ///< one per axis
    Pose X_WB = Pose::Identity();
  };
  TimeNs zero_ns = 0;  ///< time in the recording at which the simulation starts
  double step_s = 0;
  std::vector<Step> steps;  ///< at least one step

  TimeNs end_ns() const {
    return zero_ns + FromSeconds(static_cast<double>(steps.size() - 1) * step_s);
  }
  double RateAt(TimeNs t_ns, std::size_t axis) const;
  double PositionAt(TimeNs t_ns, std::size_t axis) const;
  Pose PoseAt(TimeNs t_ns) const;
};

}  // namespace tera
