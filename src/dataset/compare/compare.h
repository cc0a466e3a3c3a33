#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/compare/picture_comparison.h"
#include "dataset/compare/scan_comparison.h"
#include "dataset/compare/trajectory_error.h"

namespace tera {

/// Difference of one column of two channels over their common time.
struct ChannelDifference {
  std::string channel;  ///< "imu_boom", "joints": the channel's folder within its machine
  std::string column;   ///< "wx_radps", "boom_rad"
  std::size_t count = 0;
  double rmse = 0;  ///< in the column's unit
  double mean = 0;  ///< mean of b - a
};

/// Trajectories of a machine or of one of its antennas, with the errors under each alignment.
struct TrackComparison {
  /// Known part of the rotations.
  enum class Rotation { kAll, kHeading, kNone };

  std::string of;  ///< "poses", "gnss_left"
  Rotation rotation = Rotation::kAll;
  Trajectory a, b;
  TrajectoryError unaligned, aligned_se2, aligned_se3;
  std::vector<std::string> doubts;  ///< results of TrackDoubts
};

/// The comparison of one machine that both recordings have.
struct MachineComparison {
  std::string name_a, name_b;
  /// From poses, or from the common antennas if one side has no poses. Empty without either, as for
  /// a parked machine.
  std::vector<TrackComparison> tracks;
  std::vector<ChannelDifference> channels;
  std::vector<ScanComparison> scans;
  std::vector<PictureComparison> pictures;
  std::vector<std::string> remarks;  ///< on omitted comparisons
};

/// Two recordings: `a` is the reference, `b` is evaluated.
struct Comparison {
  std::string name_a, name_b;
  std::string times;  ///< basis of the time alignment (TimeAlignment::told)
  std::vector<MachineComparison> machines;
};

/// Compares two recordings, simulated or real. Machines are matched by name, or as the only machine
/// of each side. If one side has no poses, the antennas of both are compared (TracksOfReceivers).
/// Sensor channels of numbers over time, without receivers, are matched by folder name and their
/// numbers by column name. Samples of `b` are interpolated to the times of `a`. Scans and pictures
/// of one sensor are compared in pairs, one of `every` pairs. AlignTimes aligns the times.
///
/// Throws  InputError if either cannot be read, or they share no machine or no data of any machine.
Comparison Compare(const std::filesystem::path& a, const std::filesystem::path& b,
                   std::size_t every = 1);

/// The comparison as text for a terminal.
std::string ComparisonTable(const Comparison& comparison);

/// Writes a PNG of the trajectories from above and the errors over time. Throws InputError without
/// gnuplot, and if no machine has trajectories.
void PlotComparison(const Comparison& comparison, const std::filesystem::path& png);

}  // namespace tera
