#include "physics/dynamics/gravity_load.h"

#include "core/units.h"
#include "physics/dynamics/inertial_effort.h"

namespace tera {

std::vector<double> GravityLoads_nm(const MachineModel& model, const Pose& X_WB,
                                    const std::vector<double>& q_rad) {
  // The effort against gravity equals that of an upward acceleration without gravity.
  MachineState state;
  for (const Pose& X_WL : ForwardKinematics(model, X_WB, q_rad)) {
    BodyState& link = state.links.emplace_back();
    link.X_WB = X_WL;
    link.a_WB_mps2 = Vec3(0, 0, kStandardGravity_mps2);
  }
  InertialEfforts efforts(model);
  efforts.Update(state);
  return efforts.joints_nm();
}

}  // namespace tera
