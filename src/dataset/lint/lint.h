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
  /// Opens one of this many frames of a camera or lidar; all of them must exist.
  int every_frame = 1;
  /// The lowest height of a ground raster. Without this function poses are not compared with the
  /// ground.
  std::function<double(const std::filesystem::path& raster)> lowest_m = {};
};

/// Place of a fault in a dataset.
struct LintPlace {
  std::string file;  ///< relative to the dataset
  int line = 0;      ///< 0: none, as in a picture
  std::string message;
};

/// One rule's findings in one channel.
struct LintFinding {
  const LintRule* rule = nullptr;
  std::string channel;            ///< empty: the whole dataset
  std::int64_t count = 0;         ///< number of places
  std::vector<LintPlace> places;  ///< the first of them
};

/// Numbers of one channel, for the page of statistics.
struct ChannelStatistics {
  std::string type;
  std::int64_t rows = 0;
  TimeNs first_ns = 0, last_ns = 0;
  TimeNs median_interval_ns = 0, longest_interval_ns = 0;
};

/// Number of observations, and their distance.
struct ClassStatistics {
  std::int64_t pixels = 0, boxes = 0, points = 0;
};

/// Ranges of depth pictures and scans in bins of one metre; the last bin includes all larger ones.
using RangeHistogram = std::array<std::int64_t, 66>;

struct DatasetStatistics {
  std::map<std::string, ChannelStatistics> channels;  ///< by path
  std::map<std::string, ClassStatistics> classes;     ///< by name
  RangeHistogram depth_m = {}, range_m = {};
  std::int64_t pictures = 0, scans = 0, boxes = 0, points = 0;
};

/// Result of a lint.
struct LintReport {
  std::filesystem::path dataset;
  std::string name;                             ///< from dataset.yaml
  std::vector<LintFinding> findings;            ///< worst first, then in order of the rules
  std::vector<const LintRule*> applied;         ///< rules with data to check
  std::vector<const LintRule*> not_applicable;  ///< rules without data to check
  DatasetStatistics statistics;

  /// Number of findings of a severity, each counted once for all its places.
  std::int64_t CountOf(Severity severity) const;
};

/// Checks a complete recording, simulated or real, against the rules. Writes nothing. Memory grows
/// only by the list of frame times.
///
/// Throws  InputError if `dataset` is no recording or its dataset.yaml cannot be read.
LintReport Lint(const std::filesystem::path& dataset, const LintOptions& options = {});

/// File with the hashes of a dataset's files.
inline constexpr char kFrameHashesName[] = "frames.sha256";

/// Writes frames.sha256: a line for each file of a channel, sorted by name, for `sha256sum -c`.
/// Returns the number of files. Throws InputError.
std::int64_t WriteFrameHashes(const std::filesystem::path& dataset);

}  // namespace tera
