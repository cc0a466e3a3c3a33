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

AntennaPlace TrueAntenna(const Antenna& own, const Antenna& other) {
  const bool swapped =
      FindEffect(own.effects, "antenna_swap") || FindEffect(other.effects, "antenna_swap");
  const Antenna& heard = swapped ? other : own;
  AntennaPlace place{heard.link, TrueMount(heard.X_BS, heard.effects)};
  const double yaw_rad = (NumberOf(own.effects, "antenna_yaw", "yaw_deg", 0) +
                          NumberOf(other.effects, "antenna_yaw", "yaw_deg", 0)) *
                         kDeg;
  if (yaw_rad != 0) {
    const Vec3 middle_m = 0.5 * (own.X_BS.translation() + other.X_BS.translation());
    const Mat3 turn = RotationFromRpy(0, 0, yaw_rad);
    place.X_BT.translation() = middle_m + turn * (place.X_BT.translation() - middle_m);
    place.X_BT.linear() = turn * place.X_BT.linear();
  }
  return place;
}

Vec3 AxisSigns(const Effects& effects) {
  return Vec3::Ones() - 2 * VectorOf(effects, "axis_flip", "x", "y", "z");
}

}  // namespace tera
