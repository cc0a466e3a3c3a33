#include "sensors/gnss/antenna_pair.h"

#include "core/units.h"
#include "sensors/slots/effect_numbers.h"
#include "sensors/slots/true_mount.h"

namespace tera {

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

const SensorDescription* OtherAntenna(const SensorDescription& sensor,
                                      const std::vector<SensorDescription>& sensors) {
  const SensorDescription* other = nullptr;
  for (const SensorDescription& s : sensors) {
    if (!std::holds_alternative<GnssModel>(s.model) || s.name == sensor.name) continue;
    if (other) return nullptr;
    other = &s;
  }
  return other;
}

}  // namespace tera
