#pragma once

#include "core/config/config.h"
#include "physics/description/machine.h"

namespace tera {

/// The two levers that drive a machine.
struct SkidSteerLevers {
  int left = -1, right = -1;
};

/// Reads `left_lever` and `right_lever` (default left_track and right_track). A machine without
/// them, or without a gauge, is a fault.
SkidSteerLevers ReadSkidSteerLevers(const ConfigMap& config, const MachineModel& model);

/// Lever positions for a forward speed and yaw rate without slip: v -+ w B / 2 over the speed at
/// full lever. Both are scaled together if one exceeds full lever. Writes both into `levers`.
void SetSkidSteer(const MachineModel& model, const SkidSteerLevers& which, double forward_mps,
                  double yaw_rate_radps, std::vector<double>* levers);

}  // namespace tera
