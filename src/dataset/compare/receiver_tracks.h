#pragma once

#include <string>
#include <vector>

#include "dataset/compare/trajectory_error.h"
#include "dataset/format/recording.h"

namespace tera {

/// A machine of one of two recordings.
struct RecordedMachine {
  const Recording* recording = nullptr;
  std::string name;
  TimeNs shift_ns = 0;  ///< to add to its times
};

/// Positions of an antenna in two recordings, with the heading if a second antenna gives it.
struct AntennaTracks {
  std::string antenna, heading;  ///< "gnss_left", "gnss_left to gnss_right"; empty: unknown
  Trajectory a, b;               ///< no roll and pitch; identity if the heading is unknown
  TimeNs max_gap_ns = kNsPerSecond;
};

struct ReceiverTracks {
  std::vector<AntennaTracks> antennas;
  std::vector<std::string> remarks;  ///< omitted comparisons, and differences of the known mounts
};

/// Fixes of the receivers that two recordings of a machine have in common.
///
/// Frames  W east, north and up at the origin of `a`; P the link that carries the antennas.
/// Model   receivers are matched by name, or as the only receiver of each side. Latitude, longitude
///         and height are converted to W by WGS 84. If the origins are more than 100 km apart, as
///         for a simulation at another place, each recording keeps its own east, north and up. The
///         yaw of P comes from the first two antennas on it with mounts that both recordings know
///         (AntennaPair); it applies only to antennas on P. Without such a pair the yaw is unknown.
///         An antenna whose mount in `b` differs from that in `a` is moved to its mount in `a` by
///         that yaw.
/// Omits   roll and pitch of P, by which a move of 1 m errs by 0.09 m at 5 deg.
ReceiverTracks TracksOfReceivers(const RecordedMachine& a, const RecordedMachine& b);

}  // namespace tera
