#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/format/recording.h"

namespace tera {

/// Two receivers of a machine, whose antennas give its heading.
///
/// Frames  W east, north, up; P the link that carries both, x forward, y left, z up.
/// Model   the horizontal direction of the measured baseline minus that of the mounted one: heading
///         = 90 deg - (yaw of p_W,21 - yaw of p_P,21), clockwise from north.
/// Omits   roll and pitch of P, which turn the baseline's horizontal direction by a product of the
///         baseline's slope and the tilt.
class AntennaPair {
 public:
  /// The pair among a machine's receivers: exactly two on one link, with known mounts and a
  /// horizontal baseline. Otherwise nothing.
  static std::optional<AntennaPair> Of(const Recording& recording,
                                       const std::vector<std::string>& receivers);

  /// The pair of antennas at these positions in P; nothing without a horizontal baseline.
  static std::optional<AntennaPair> At(const Vec3& first_P_m, const Vec3& second_P_m);

  /// Heading of P from a fix of each at the same time, the first receiver's first.
  double Heading_rad(const GnssSample& first, const GnssSample& second) const;
  /// Yaw of P in W, from east, from the antennas' positions in W.
  double Yaw_rad(const Vec3& first_W_m, const Vec3& second_W_m) const;

 private:
  explicit AntennaPair(double mounted_yaw_rad) : mounted_yaw_rad_(mounted_yaw_rad) {}
  double mounted_yaw_rad_;
};

}  // namespace tera
