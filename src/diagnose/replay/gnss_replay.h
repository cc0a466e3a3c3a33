#pragma once

#include <optional>
#include <vector>

#include "diagnose/replay/link_track.h"
#include "sensors/sensor.h"

namespace tera {

/// What one receiver measured, and how the links moved that matter to it.
///
/// Frames  W of the poses, which is that of the site; B the link of the boom; S the antenna.
/// Model   positions with the documented fix or a better one, stamped within the track; links are
///         posed every 0.05 s.
/// Omits   positions of a worse fix, which the receiver tells itself, and the variances that it
///         gives.
struct ReceiverLog {
  LinkTrack track;                       ///< of the antenna's link
  std::vector<TimeNs> t_ns;              ///< as stamped; times rise
  std::vector<Vec3> p_WS_m;              ///< as measured
  std::vector<bool> known;               ///< what moves the antenna was measured about then
  std::optional<LinkTrack> boom;         ///< of the part that rises beside it, where one does
  Vec3 boom_direction_B = Vec3::Zero();  ///< from its foot to its tip, in its link's frame
};

/// Receivers that are compared together: one, or the two of a pair.
using GnssLog = std::vector<ReceiverLog>;

/// One log a receiver. No positions where the track is empty, or the receiver had no such fix
/// meanwhile.
GnssLog MakeGnssLog(const MachineModel& model, const std::vector<SensorDescription>& receivers,
                    const std::vector<std::vector<GnssSample>>& samples,
                    const std::vector<NamedEncoders>& encoders,
                    const std::vector<TruthPose>& poses);

/// Receivers carried along a measured motion.
///
/// Model   the antenna at its true mount (TrueAntenna of a pair) when its clock said what the stamp
///         says, its documented bias, then the slots of a receiver: `multipath` of the part that
///         rises, datums, filter, steps.
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
