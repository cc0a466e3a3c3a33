#pragma once

#include <string>
#include <vector>

#include "diagnose/replay/axis_log.h"

namespace tera {

/// Motion of a link at even times.
///
/// Frames  W of the poses, L link.
struct LinkTrack {
  TimeNs start_ns = 0, step_ns = 0;
  std::vector<Pose> X_WL;
  std::vector<bool> known;  ///< at each time, whether a measurement is near enough

  TimeNs t_ns(std::size_t k) const { return start_ns + static_cast<TimeNs>(k) * step_ns; }
  /// Pose at a time, interpolated; outside the track, the nearest pose. The track must have times.
  Pose At(TimeNs at_ns) const;
  /// Position of a point of the link at a time, linear between two times.
  Vec3 PointAt(TimeNs at_ns, const Vec3& p_L_m) const;
};

/// The track of a link over [`from_ns`, `to_ns`], from the poses of the base and the encoders of
/// the joints between base and link.
///
/// Model   poses and angles are linear between measurements. Without poses, a machine whose
///         tracks or wheels were measured and never turned stands still and level.
/// Omits   the attitude of a machine that stands.
///
/// Empty where a moving joint on the way has no encoder, or the base's pose is not known.
LinkTrack TrackOfLink(const MachineModel& model, const std::vector<NamedEncoders>& encoders,
                      const std::vector<TruthPose>& poses, int link, TimeNs from_ns, TimeNs to_ns,
                      TimeNs step_ns);

}  // namespace tera
