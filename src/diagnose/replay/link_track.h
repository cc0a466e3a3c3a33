#pragma once

#include <string>
#include <vector>

#include "diagnose/replay/axis_log.h"

namespace tera {

/// Poses of a link at even times.
///
/// Frames  W world frame of the poses, L link.
struct LinkTrack {
  TimeNs start_ns = 0, step_ns = 0;
  std::vector<Pose> X_WL;
  std::vector<bool> known;  ///< true if measurements are near enough on both sides of the time

  TimeNs t_ns(std::size_t k) const { return start_ns + static_cast<TimeNs>(k) * step_ns; }
  /// Interpolated pose. Outside the track, the nearest pose. The track must not be empty.
  Pose At(TimeNs at_ns) const;
  /// Position of a point of the link, linear between two track times.
  Vec3 PointAt(TimeNs at_ns, const Vec3& p_L_m) const;
};

/// Track of a link over [`from_ns`, `to_ns`], from the base's poses and the encoders of the joints
/// between base and link.
///
/// Model   Poses and angles are linear between measurements. Without poses, a machine stands still
///         and level if all its running gears were measured and none turned.
/// Omits   The true attitude of a machine without poses.
///
/// Returns an empty track if a moving joint on the way has no encoder, or if the base's motion is
/// unknown.
LinkTrack TrackOfLink(const MachineModel& model, const std::vector<NamedEncoders>& encoders,
                      const std::vector<TruthPose>& poses, int link, TimeNs from_ns, TimeNs to_ns,
                      TimeNs step_ns);

}  // namespace tera
