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
  TimeNs shift_ns = 0;  ///< to be added to its times
};

/// Where an antenna was in two recordings, and which way it faced where a second one tells.
struct AntennaTracks {
  std::string antenna, heading;  ///< "gnss_left", "gnss_left to gnss_right"; empty: not known
  Trajectory a, b;               ///< no roll and pitch; identity where the heading is not known
  TimeNs max_gap_ns = kNsPerSecond;
};

struct ReceiverTracks {
  std::vector<AntennaTracks> antennas;
  std::vector<std::string> remarks;  ///< what could not be compared, or differs by what is known
};

/// The fixes of receivers that two recordings of a machine have in common.
///
/// Frames  W east, north and up at the origin of `a`; P the link that carries the antennas.
/// Model   receivers are matched by name, or where each side has one, those two. Latitude,
///         longitude and height of both are taken to W by WGS 84; with origins more than 100 km
///         apart, as of a simulation at a place of its own, each keeps its own east, north and up.
///         The yaw of P is that of the first two antennas on it whose places on P both recordings
///         know (AntennaPair), and that of antennas on P alone; without such two none is known. An
///         antenna that by its mount sits elsewhere on P in `b` than in `a` is moved by that yaw
///         to where it sits in `a`.
/// Omits   roll and pitch of P, by which a move by 1 m errs by 0.09 m at 5 deg.
ReceiverTracks TracksOfReceivers(const RecordedMachine& a, const RecordedMachine& b);

}  // namespace tera
