#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/compare/trajectory_error.h"

namespace tera {

/// Difference of one number of two channels over the time that both have.
struct ChannelDifference {
  std::string channel;  ///< "imu_boom", "joints": the channel's folder within its machine
  std::string column;   ///< "wx_radps", "boom_rad"
  std::size_t count = 0;
  double rmse = 0;  ///< in the column's unit
  double mean = 0;  ///< of b - a
};

/// The trajectories of a machine, or of an antenna on it, and the errors under each alignment.
struct TrackComparison {
  /// The part of the rotations that the trajectories tell.
  enum class Rotation { kAll, kHeading, kNone };

  std::string of;  ///< "poses", "gnss_left"
  Rotation rotation = Rotation::kAll;
  Trajectory a, b;
  TrajectoryError unaligned, aligned_se2, aligned_se3;
  std::vector<std::string> doubts;  ///< TrackDoubts
};

/// The comparison of one machine that both recordings have.
struct MachineComparison {
  std::string name_a, name_b;
  /// By poses; where a side has none, by the antennas that both have; else none, as of a machine
  /// that is parked.
  std::vector<TrackComparison> tracks;
  std::vector<ChannelDifference> channels;
  std::vector<std::string> remarks;  ///< on what could not be compared
};

/// Two recordings side by side: `a` is the reference, `b` is judged.
struct Comparison {
  std::string name_a, name_b;
  std::string times;  ///< by what times are compared (TimeAlignment::told)
  std::vector<MachineComparison> machines;
};

/// Compares two recordings, simulated or real. Machines are matched by name; where each side has
/// just one, those two. Where poses of a side are missing, the antennas of both are compared
/// (TracksOfReceivers). Channels of sensors whose rows are numbers over time (not
/// of receivers) are matched by folder name, their numbers by column name; samples of `b` are
/// interpolated to the times of `a`. Times are compared by AlignTimes.
/// Throws InputError if either cannot be read, or they share no machine or nothing of any machine.
Comparison Compare(const std::filesystem::path& a, const std::filesystem::path& b);

/// The comparison as text for a terminal.
std::string ComparisonTable(const Comparison& comparison);

/// The trajectories from above and the errors over time as a PNG. Throws InputError without
/// gnuplot, and where no machine has trajectories.
void PlotComparison(const Comparison& comparison, const std::filesystem::path& png);

}  // namespace tera
