#pragma once

#include <string>
#include <vector>

#include "diagnose/replay/axis_log.h"

namespace tera {

/// How a link moved, at even times.
///
/// Frames  W of the poses, L link.
struct LinkTrack {
  TimeNs start_ns = 0, step_ns = 0;
  std::vector<Pose> X_WL;
  std::vector<bool> known;  ///< of each time, whether measurements are near enough to tell

  TimeNs t_ns(std::size_t k) const { return start_ns + static_cast<TimeNs>(k) * step_ns; }
  /// Between two times; beyond the first and the last, as it was then. Of a track that has times.
  Pose At(TimeNs at_ns) const;
  /// Where a point of the link is then, on a straight line between two times.
  Vec3 PointAt(TimeNs at_ns, const Vec3& p_L_m) const;
};

/// From the poses of the base and the encoders of the joints between base and link, over
/// [`from_ns`, `to_ns`].
///
/// Model   poses and angles are straight between measurements. Without poses, a machine whose
///         tracks or wheels were measured and never turned stands still and level.
/// Omits   how a standing machine leans.
///
/// Empty where a moving joint on the way has no encoder, or nothing tells where the base was.
LinkTrack TrackOfLink(const MachineModel& model, const std::vector<NamedEncoders>& encoders,
                      const std::vector<TruthPose>& poses, int link, TimeNs from_ns, TimeNs to_ns,
                      TimeNs step_ns);

}  // namespace tera
