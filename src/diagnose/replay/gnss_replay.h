#pragma once

#include <optional>
#include <vector>

#include "diagnose/replay/link_track.h"
#include "sensors/sensor.h"

namespace tera {

/// Positions measured by one receiver, and the motion of the links that they depend on.
///
/// Frames  W of the poses, equal to the site's; B the link of the boom; S the antenna.
/// Model   positions with the documented fix or a better one, with stamps within the track; links
///         have poses every 0.05 s.
/// Omits   positions with a worse fix, which the receiver itself reports, and its variances.
struct ReceiverLog {
  LinkTrack track;                       ///< of the antenna's link
  std::vector<TimeNs> t_ns;              ///< as stamped; times rise
  std::vector<Vec3> p_WS_m;              ///< as measured
  std::vector<bool> known;               ///< whether the antenna's motion was measured at that time
  std::optional<LinkTrack> boom;         ///< link of a rising part next to the antenna, if present
  Vec3 boom_direction_B = Vec3::Zero();  ///< from its foot to its tip, in its link's frame
};

/// Receivers that are compared together: one, or the two of a pair.
using GnssLog = std::vector<ReceiverLog>;

/// One log for each receiver, without positions where the track is empty, or where the receiver
/// never had such a fix.
GnssLog MakeGnssLog(const MachineModel& model, const std::vector<SensorDescription>& receivers,
                    const std::vector<std::vector<GnssSample>>& samples,
                    const std::vector<NamedEncoders>& encoders,
                    const std::vector<TruthPose>& poses);

/// Positions that receivers would have measured along a measured motion.
///
/// Model   position of the antenna at its true mount (TrueAntenna of a pair) at the time when its
///         clock showed the stamp, with its documented bias. Then the slots of a receiver:
///         `multipath` of the rising part, datums, filter, steps.
/// Omits   noise, and the random effects `float_jump`, `outliers` and jitter of `latency`.
class GnssReplay {
 public:
  /// Both must outlive it. There are as many receivers as logs, one or two.
  GnssReplay(const std::vector<SensorDescription>& receivers, const GnssLog& log)
      : receivers_(receivers), log_(log) {}

  /// Positions of receiver `r` at its stamps; `effects` of all receivers in place of their own.
  std::vector<Vec3> Predict(std::size_t r, const std::vector<Effects>& effects) const;

 private:
  const std::vector<SensorDescription>& receivers_;
  const GnssLog& log_;
};

}  // namespace tera
