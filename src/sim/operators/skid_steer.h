#pragma once

#include "core/config/config.h"
#include "physics/description/machine.h"

namespace tera {

/// Indices of the levers of the left and the right track or wheels.
struct SkidSteerLevers {
  int left = -1, right = -1;
};

/// Reads `left_lever` and `right_lever` (default left_track and right_track). It is a fault if the
/// machine lacks them or has no gauge.
SkidSteerLevers ReadSkidSteerLevers(const ConfigMap& config, const MachineModel& model);

/// Sets the two levers for a forward speed v and a yaw rate w, without slip: (v -+ w B / 2) divided
/// by the speed at full lever, where B is the gauge. If one exceeds full lever, both are reduced by
/// the same factor.
void SetSkidSteer(const MachineModel& model, const SkidSteerLevers& which, double forward_mps,
                  double yaw_rate_radps, std::vector<double>* levers);

}  // namespace tera
