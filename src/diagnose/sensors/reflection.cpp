#include "diagnose/sensors/reflection.h"

#include <cmath>

#include "sensors/gnss/gnss_reflector.h"

namespace tera {

std::optional<RaisedPart> RaisedPartOf(const MachineModel& model, int antenna_link,
                                       const std::vector<int>& places) {
  const auto part = GnssReflectorOf(model, antenna_link);
  if (!part) return std::nullopt;
  const auto chain = ChainTo(model, part->link, places);
  if (!chain || chain->steps.empty()) return std::nullopt;
  return RaisedPart{*chain, part->direction_B};
}

double LargestReflection_m(GnssFix fix) {
  constexpr double kOfPhases_m = 0.22, kOfCodes_m = 5;
  return fix == GnssFix::kRtkFixed ? kOfPhases_m : kOfCodes_m;
}

Eigen::Vector4d LinearReflection(const Reflection& reflection) {
  const double c = std::cos(reflection.azimuth_rad), s = std::sin(reflection.azimuth_rad);
  return {reflection.horizontal_m * c, reflection.horizontal_m * s, reflection.vertical_m * c,
          reflection.vertical_m * s};
}

Reflection ReflectionOf(const Eigen::Vector4d& numbers) {
  const double azimuth_rad = std::atan2(numbers[1], numbers[0]);
  return {numbers.head<2>().norm(),
          numbers[2] * std::cos(azimuth_rad) + numbers[3] * std::sin(azimuth_rad), azimuth_rad};
}

}  // namespace tera
