#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/types/measurement.h"
#include "dataset/format/recording.h"

namespace tera {

/// Two GNSS antennas of a machine, which together measure its heading.
///
/// Frames  W east, north, up; P the link that carries both antennas: x forward, y left, z up.
/// Model   p_21 is the baseline from the first to the second antenna. heading = 90 deg - (yaw of
///         p_W,21 - yaw of p_P,21), clockwise from north.
/// Omits   roll and pitch of P. They change the baseline's yaw by the product of its slope and the
///         tilt.
class AntennaPair {
 public:
  /// Finds the pair among the receivers of a machine. Returns nullopt unless exactly two receivers
  /// are on one link, their mounts are known, and their baseline has a horizontal component.
  static std::optional<AntennaPair> Of(const Recording& recording,
                                       const std::vector<std::string>& receivers);

  /// The pair with antennas at these positions in P. Returns nullopt if the baseline has no
  /// horizontal component.
  static std::optional<AntennaPair> At(const Vec3& first_P_m, const Vec3& second_P_m);

  /// Heading of P from simultaneous fixes of the first and the second receiver.
  double Heading_rad(const GnssSample& first, const GnssSample& second) const;
  /// Yaw of P in W, counted from east, from the positions of the antennas in W.
  double Yaw_rad(const Vec3& first_W_m, const Vec3& second_W_m) const;

 private:
  explicit AntennaPair(double mounted_yaw_rad) : mounted_yaw_rad_(mounted_yaw_rad) {}
  double mounted_yaw_rad_;
};

}  // namespace tera
