#include "dataset/export/gnss/antenna_pair.h"

#include <cmath>

#include "core/units.h"
#include "dataset/format/sensor_sheet.h"

namespace tera {
namespace {

/// A shorter horizontal baseline tells no direction: receivers measure to some centimetres.
constexpr double kShortestBaseline_m = 0.2;

}  // namespace

std::optional<AntennaPair> AntennaPair::Of(const Recording& recording,
                                           const std::vector<std::string>& receivers) {
  if (receivers.size() != 2) return std::nullopt;
  const SensorSheet first = ReadSensorSheet(recording.directory() / receivers[0]);
  const SensorSheet second = ReadSensorSheet(recording.directory() / receivers[1]);
  if (!first.X_PS || !second.X_PS || first.parent_link != second.parent_link) return std::nullopt;
  const Vec3 baseline_m = second.X_PS->translation() - first.X_PS->translation();
  if (baseline_m.head<2>().norm() < kShortestBaseline_m) return std::nullopt;
  return AntennaPair(std::atan2(baseline_m.y(), baseline_m.x()));
}

double AntennaPair::Heading_rad(const GnssSample& first, const GnssSample& second) const {
  const Vec3 baseline_m = second.enu_m - first.enu_m;
  const double measured_yaw_rad = std::atan2(baseline_m.y(), baseline_m.x());
  return 90 * kDeg - (measured_yaw_rad - mounted_yaw_rad_);
}

}  // namespace tera
