#pragma once

#include <optional>
#include <vector>

#include "diagnose/replay/link_track.h"
#include "sensors/sensor.h"

namespace tera {

/// Measured positions of one receiver, and the motion of the links on which the positions depend.
///
/// Frames  W world frame of the poses and the site; B link of the boom; S the antenna.
/// Model   Only positions with the documented fix or a better one, and with stamps within the
///         track, are kept. Tracks have a pose every 0.05 s.
/// Omits   Positions with a worse fix, which the receiver itself reports; the receiver's variances.
struct ReceiverLog {
  LinkTrack track;           ///< motion of the antenna's link
  std::vector<TimeNs> t_ns;  ///< stamps, ascending
  std::vector<Vec3> p_WS_m;  ///< measured positions of the antenna
  std::vector<bool> known;   ///< true if the antenna's motion was measured at that time
  /// Motion of a boom that reflects signals to the antenna, if present.
  std::optional<LinkTrack> boom;
  Vec3 boom_direction_B = Vec3::Zero();  ///< direction from the boom's foot to its tip
};

/// Logs of the receivers that are compared together: one, or a pair.
using GnssLog = std::vector<ReceiverLog>;

/// Makes one log per receiver. A log is empty if the motion of the antenna's link is unknown. A log
/// has no positions if the receiver never had the documented fix.
GnssLog MakeGnssLog(const MachineModel& model, const std::vector<SensorDescription>& receivers,
                    const std::vector<std::vector<GnssSample>>& samples,
                    const std::vector<NamedEncoders>& encoders,
                    const std::vector<TruthPose>& poses);

/// Predicts the positions that receivers measure along a measured motion.
///
/// Model   The antenna is at its true mount (TrueAntenna for a pair), with its documented bias. The
///         position is taken at the time at which the receiver's clock shows the stamp. The
///         receiver's error mechanisms follow in the simulator's order: `multipath` of the boom,
///         datums, filter, steps.
/// Omits   Noise, and the random effects `float_jump`, `outliers` and jitter of `latency`.
class GnssReplay {
 public:
  /// `receivers` and `log` must outlive this object, and have the same number of entries, one or
  /// two.
  GnssReplay(const std::vector<SensorDescription>& receivers, const GnssLog& log)
      : receivers_(receivers), log_(log) {}

  /// Positions of receiver `r` at its stamps. `effects` replace those of all receivers.
  std::vector<Vec3> Predict(std::size_t r, const std::vector<Effects>& effects) const;

 private:
  const std::vector<SensorDescription>& receivers_;
  const GnssLog& log_;
};

}  // namespace tera
