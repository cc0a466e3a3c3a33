#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "dataset/compare/picture_comparison.h"
#include "dataset/compare/scan_comparison.h"
#include "dataset/compare/trajectory_error.h"

namespace tera {

/// Difference of one column between two channels over their common time.
struct ChannelDifference {
  std::string channel;  ///< folder within the machine, such as "imu_boom"; "joints" for a table
  std::string column;   ///< such as "wx_radps" or "boom_rad"
  std::size_t count = 0;
  double rmse = 0;  ///< in the column's unit
  double mean = 0;  ///< mean of b - a
};

/// Trajectories of a machine or of one of its antennas, with their errors.
struct TrackComparison {
  /// Known part of the rotation.
  enum class Rotation { kAll, kHeading, kNone };

  std::string of;  ///< such as "poses" or "gnss_left"
  Rotation rotation = Rotation::kAll;
  Trajectory a, b;
  TrajectoryError unaligned, aligned_se2, aligned_se3;
  std::vector<std::string> doubts;  ///< results of TrackDoubts
};

/// Comparison of a machine that both recordings have.
struct MachineComparison {
  std::string name_a, name_b;
  /// One track from poses; or tracks of common antennas if either side has no poses. Empty without
  /// any, as for a parked machine.
  std::vector<TrackComparison> tracks;
  std::vector<ChannelDifference> channels;
  std::vector<ScanComparison> scans;
  std::vector<PictureComparison> pictures;
  std::vector<std::string> remarks;  ///< remarks on comparisons that are omitted
};

/// Comparison of two recordings: `a` is the reference, `b` is evaluated.
struct Comparison {
  std::string name_a, name_b;
  std::string times;  ///< description of the time alignment (TimeAlignment::told)
  std::vector<MachineComparison> machines;
};

/// Compares two recordings, simulated or real. Machines are matched by name; if each side has only
/// one machine, these are matched. Poses are compared, or antenna positions if a side has no poses
/// (TracksOfReceivers). Time series, except those of GNSS receivers, are matched by folder and
/// column name, with `b` interpolated at the times of `a`. Scans and images are compared in pairs
/// of frames; one pair out of `every` is used. AlignTimes aligns the times.
///
/// Throws  InputError if a recording cannot be read, or if the recordings have no machine or no
///         data of any machine in common.
Comparison Compare(const std::filesystem::path& a, const std::filesystem::path& b,
                   std::size_t every = 1);

/// Text of the comparison for a terminal.
std::string ComparisonTable(const Comparison& comparison);

/// Writes a PNG with trajectories from above and errors over time. Throws InputError if gnuplot is
/// missing or no machine has trajectories.
void PlotComparison(const Comparison& comparison, const std::filesystem::path& png);

}  // namespace tera
