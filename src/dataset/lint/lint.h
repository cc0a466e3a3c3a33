#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "core/time.h"
#include "dataset/lint/rules.h"

namespace tera {

struct LintOptions {
  /// Every how many frames of a camera or lidar one is opened; all of them have to be there.
  int every_frame = 1;
  /// The lowest height of a raster of the ground, for whoever can read it; without it poses are
  /// not held to the ground.
  std::function<double(const std::filesystem::path& raster)> lowest_m = {};
};

/// Where a dataset is not as it must be.
struct LintPlace {
  std::string file;  ///< relative to the dataset
  int line = 0;      ///< 0: none, as in a picture
  std::string message;
};

/// What one rule has found in one channel.
struct LintFinding {
  const LintRule* rule = nullptr;
  std::string channel;            ///< empty: the dataset as a whole
  std::int64_t count = 0;         ///< of places
  std::vector<LintPlace> places;  ///< the first of them
};

/// Numbers of one channel, for the page of statistics.
struct ChannelStatistics {
  std::string type;
  std::int64_t rows = 0;
  TimeNs first_ns = 0, last_ns = 0;
  TimeNs median_interval_ns = 0, longest_interval_ns = 0;
};

/// How often something was seen, and how far away.
struct ClassStatistics {
  std::int64_t pixels = 0, boxes = 0, points = 0;
};

/// Ranges of depth pictures and scans, counted by whole metres; the last also counts all beyond.
using RangeHistogram = std::array<std::int64_t, 66>;

struct DatasetStatistics {
  std::map<std::string, ChannelStatistics> channels;  ///< by path
  std::map<std::string, ClassStatistics> classes;     ///< by name
  RangeHistogram depth_m = {}, range_m = {};
  std::int64_t pictures = 0, scans = 0, boxes = 0, points = 0;
};

/// What became of a dataset.
struct LintReport {
  std::filesystem::path dataset;
  std::string name;                             ///< as dataset.yaml has it
  std::vector<LintFinding> findings;            ///< worst first, then in order of the rules
  std::vector<const LintRule*> applied;         ///< rules that had something to look at
  std::vector<const LintRule*> not_applicable;  ///< and those that had nothing
  DatasetStatistics statistics;

  /// Findings of a severity, each counted once whatever its number of places.
  std::int64_t CountOf(Severity severity) const;
};

/// Holds a complete recording, simulated or real, to the rules. Nothing is written. Memory does not
/// grow with the number of frames but by the list of their times.
///
/// Throws InputError where `dataset` is no recording or its dataset.yaml cannot be read.
LintReport Lint(const std::filesystem::path& dataset, const LintOptions& options = {});

/// Where hashes of a dataset's files are.
inline constexpr char kFrameHashesName[] = "frames.sha256";

/// Writes frames.sha256: a line for each file of a channel, sorted by name, in the form that
/// `sha256sum -c` reads. Returns the number of files. Throws InputError.
std::int64_t WriteFrameHashes(const std::filesystem::path& dataset);

}  // namespace tera
