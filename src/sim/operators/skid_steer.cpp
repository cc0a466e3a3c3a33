#include "sim/operators/skid_steer.h"

#include <algorithm>
#include <cmath>

namespace tera {
namespace {

int DriveLever(const ConfigMap& config, std::string_view key, std::string_view otherwise,
               const MachineModel& model) {
  const std::string name = config.Text(key, otherwise);
  const int lever = model.LeverIndex(name);
  if (lever < 0 || model.levers[lever].gear < 0) {
    config.Fault(
        key, {FaultKind::kNoSuchName, "machine '" + model.kind + "' has no lever '" + name +
                                          "' that drives tracks or wheels; name one that does"});
    return -1;
  }
  return lever;
}

/// Ground speed at full lever, without slip.
double FullSpeed_mps(const MachineModel& model, int lever) {
  const int gear = model.levers[lever].gear;
  return model.gear_drives[gear].max_rate_radps * model.ground_tools.gears[gear].drive_radius_m;
}

}  // namespace

SkidSteerLevers ReadSkidSteerLevers(const ConfigMap& config, const MachineModel& model) {
  if (model.gauge_m <= 0) {
    config.Fault("", {FaultKind::kMissing,
                      "machine '" + model.kind + "' has no gauge_m, so it cannot be steered"});
  }
  return {DriveLever(config, "left_lever", "left_track", model),
          DriveLever(config, "right_lever", "right_track", model)};
}

void SetSkidSteer(const MachineModel& model, const SkidSteerLevers& which, double forward_mps,
                  double yaw_rate_radps, std::vector<double>* levers) {
  const double half_mps = 0.5 * yaw_rate_radps * model.gauge_m;
  const double left = (forward_mps - half_mps) / FullSpeed_mps(model, which.left);
  const double right = (forward_mps + half_mps) / FullSpeed_mps(model, which.right);
  const double scale = std::max({1.0, std::abs(left), std::abs(right)});
  (*levers)[which.left] = left / scale;
  (*levers)[which.right] = right / scale;
}

}  // namespace tera
