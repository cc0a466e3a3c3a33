#include "dataset/format/antenna_pair.h"

#include <cmath>

#include "core/units.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {
namespace {

/// Receivers measure to some centimetres, so a shorter horizontal baseline gives no useful
/// direction.
constexpr double kShortestBaseline_m = 0.2;

}  // namespace

std::optional<AntennaPair> AntennaPair::Of(const Recording& recording,
                                           const std::vector<std::string>& receivers) {
  if (receivers.size() != 2) return std::nullopt;
  const SensorSheet first = ReadSensorSheet(recording.directory() / receivers[0]);
  const SensorSheet second = ReadSensorSheet(recording.directory() / receivers[1]);
  if (!first.X_PS || !second.X_PS || first.parent_link != second.parent_link) return std::nullopt;
  return At(first.X_PS->translation(), second.X_PS->translation());
}

std::optional<AntennaPair> AntennaPair::At(const Vec3& first_P_m, const Vec3& second_P_m) {
  const Vec3 baseline_m = second_P_m - first_P_m;
  if (baseline_m.head<2>().norm() < kShortestBaseline_m) return std::nullopt;
  return AntennaPair(std::atan2(baseline_m.y(), baseline_m.x()));
}

double AntennaPair::Yaw_rad(const Vec3& first_W_m, const Vec3& second_W_m) const {
  const Vec3 baseline_m = second_W_m - first_W_m;
  return std::atan2(baseline_m.y(), baseline_m.x()) - mounted_yaw_rad_;
}

double AntennaPair::Heading_rad(const GnssSample& first, const GnssSample& second) const {
  return 90 * kDeg - Yaw_rad(first.enu_m, second.enu_m);
}

}  // namespace tera
