#pragma once

#include "core/config/config.h"
#include "physics/description/machine.h"

namespace tera {

/// The two levers that drive a machine.
struct SkidSteerLevers {
  int left = -1, right = -1;
};

/// Reads `left_lever` and `right_lever` (left_track and right_track unless named); a machine
/// without them, or without a gauge, is a fault.
SkidSteerLevers ReadSkidSteerLevers(const ConfigMap& config, const MachineModel& model);

/// Lever positions for a forward speed and yaw rate, no slip assumed: v -+ w B / 2 over the speed
/// at full lever; scaled down together where one would exceed full lever. Writes both into
/// `levers`.
void SetSkidSteer(const MachineModel& model, const SkidSteerLevers& which, double forward_mps,
                  double yaw_rate_radps, std::vector<double>* levers);

}  // namespace tera
