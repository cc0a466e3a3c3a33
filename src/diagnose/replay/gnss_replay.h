#pragma once

#include <optional>
#include <vector>

#include "diagnose/replay/link_track.h"
#include "sensors/sensor.h"

namespace tera {

/// The positions that one receiver measured, and the motion of the links that it depends on.
///
/// Frames  W of the poses, which is that of the site; B the link of the boom; S the antenna.
/// Model   positions with the documented fix or a better one, stamped within the track; links are
///         posed every 0.05 s.
/// Omits   positions of a worse fix, which the receiver reports itself, and its variances.
struct ReceiverLog {
  LinkTrack track;                       ///< of the antenna's link
  std::vector<TimeNs> t_ns;              ///< as stamped; times rise
  std::vector<Vec3> p_WS_m;              ///< as measured
  std::vector<bool> known;               ///< whether the antenna's motion was measured at the time
  std::optional<LinkTrack> boom;         ///< of the part that rises beside it, if there is one
  Vec3 boom_direction_B = Vec3::Zero();  ///< from its foot to its tip, in its link's frame
};

/// Receivers that are compared together: one, or the two of a pair.
using GnssLog = std::vector<ReceiverLog>;

/// One log for each receiver. It has no positions where the track is empty, or the receiver had no
/// such fix meanwhile.
GnssLog MakeGnssLog(const MachineModel& model, const std::vector<SensorDescription>& receivers,
                    const std::vector<std::vector<GnssSample>>& samples,
                    const std::vector<NamedEncoders>& encoders,
                    const std::vector<TruthPose>& poses);

/// The positions that receivers would have measured along a measured motion.
///
/// Model   the antenna at its true mount (TrueAntenna of a pair) at the time when its clock showed
///         the stamp, with its documented bias; then the slots of a receiver: `multipath` of the
///         part that rises, datums, filter, steps.
/// Omits   noise; `float_jump`, `outliers` and the jitter of `latency`, which are drawn.
class GnssReplay {
 public:
  /// Both must outlive it; as many receivers as logs, one or two.
  GnssReplay(const std::vector<SensorDescription>& receivers, const GnssLog& log)
      : receivers_(receivers), log_(log) {}

  /// Positions of receiver `r` at its stamps; `effects` of all receivers in place of their own.
  std::vector<Vec3> Predict(std::size_t r, const std::vector<Effects>& effects) const;

 private:
  const std::vector<SensorDescription>& receivers_;
  const GnssLog& log_;
};

}  // namespace tera
