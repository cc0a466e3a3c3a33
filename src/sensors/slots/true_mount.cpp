#include "sensors/slots/true_mount.h"

#include "core/units.h"
#include "sensors/slots/effect_numbers.h"

namespace tera {
namespace {

Vec3 ShiftOf(const Effects& effects, std::string_view id) {
  return VectorOf(effects, id, "x_m", "y_m", "z_m");
}

Mat3 TurnOf(const Effects& effects, std::string_view id) {
  const Vec3 rpy_rad = VectorOf(effects, id, "roll_deg", "pitch_deg", "yaw_deg") * kDeg;
  return RotationFromRpy(rpy_rad.x(), rpy_rad.y(), rpy_rad.z());
}

}  // namespace

Pose TrueMount(const Pose& X_BS, const Effects& effects) {
  Pose X_BT = X_BS;
  for (const std::string_view id : {"imu_lever_arm", "gnss_lever_arm", "extrinsic"}) {
    if (FindEffect(effects, id)) X_BT.translation() += ShiftOf(effects, id);
  }
  for (const std::string_view id : {"mount_rotation", "extrinsic"}) {
    if (FindEffect(effects, id)) X_BT.linear() = X_BT.linear() * TurnOf(effects, id);
  }
  return X_BT;
}

}  // namespace tera
