#pragma once

#include <filesystem>
#include <optional>
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

/// The trajectories of one machine and its errors under each alignment.
struct MachineComparison {
  std::string name_a, name_b;
  Trajectory a, b;
  TrajectoryError unaligned, aligned_se2, aligned_se3;
  std::vector<ChannelDifference> channels;

  /// False where a side has no poses, as a recording of a parked machine may; then only the
  /// channels are compared.
  bool HasTrajectories() const { return !a.empty() && !b.empty(); }
};

/// Two recordings side by side: `a` is the reference, `b` is judged.
struct Comparison {
  std::string name_a, name_b;
  std::vector<MachineComparison> machines;
};

/// Compares two recordings, simulated or real. Machines are matched by name; where each side has
/// just one, those two. Channels of sensors whose rows are numbers over time (not
/// of receivers) are matched by folder name, their numbers by column name; samples of `b` are
/// interpolated to the times of `a`. Times are compared as they stand: both recordings must count
/// them from the same event (an imported one by its mapping's `time`).
/// Throws InputError if either cannot be read or they share no machine.
Comparison Compare(const std::filesystem::path& a, const std::filesystem::path& b);

/// The comparison as text for a terminal.
std::string ComparisonTable(const Comparison& comparison);

/// The trajectories from above and the errors over time as a PNG. Throws InputError without
/// gnuplot, and where no machine has trajectories.
void PlotComparison(const Comparison& comparison, const std::filesystem::path& png);

}  // namespace tera
