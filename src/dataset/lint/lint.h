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
  /// One out of this many frames of a camera or lidar is opened. The existence of files is checked
  /// for every frame.
  int every_frame = 1;
  /// Returns the lowest height in a ground raster. If not set, poses are not compared with the
  /// ground.
  std::function<double(const std::filesystem::path& raster)> lowest_m = {};
};

struct LintPlace {
  std::string file;  ///< path relative to the dataset
  int line = 0;      ///< 0 if the file has no lines, such as an image
  std::string message;
};

/// All findings of one rule in one channel.
struct LintFinding {
  const LintRule* rule = nullptr;
  std::string channel;  ///< empty if the finding concerns the whole dataset
  std::int64_t count = 0;
  std::vector<LintPlace> places;  ///< the first places
};

/// Statistics of one channel, for the HTML page.
struct ChannelStatistics {
  std::string type;
  std::int64_t rows = 0;
  TimeNs first_ns = 0, last_ns = 0;
  TimeNs median_interval_ns = 0, longest_interval_ns = 0;
};

/// Number of occurrences of a class.
struct ClassStatistics {
  std::int64_t pixels = 0, boxes = 0, points = 0;
};

/// Histogram of depths or ranges with bins of 1 m. The last bin contains all larger values.
using RangeHistogram = std::array<std::int64_t, 66>;

struct DatasetStatistics {
  std::map<std::string, ChannelStatistics> channels;  ///< by path
  std::map<std::string, ClassStatistics> classes;     ///< by name
  RangeHistogram depth_m = {}, range_m = {};
  std::int64_t pictures = 0, scans = 0, boxes = 0, points = 0;
};

struct LintReport {
  std::filesystem::path dataset;
  std::string name;                             ///< from dataset.yaml
  std::vector<LintFinding> findings;            ///< worst first, then in the order of the rules
  std::vector<const LintRule*> applied;         ///< rules for which the dataset has data
  std::vector<const LintRule*> not_applicable;  ///< rules for which the dataset has no data
  DatasetStatistics statistics;

  /// Number of findings of this severity; a finding with several places counts once.
  std::int64_t CountOf(Severity severity) const;
};

/// Checks a complete recording, simulated or real, against all rules. Does not write files. Memory
/// use grows only with the number of frames.
///
/// Throws  InputError if `dataset` is not a recording or its dataset.yaml cannot be read.
LintReport Lint(const std::filesystem::path& dataset, const LintOptions& options = {});

/// File with the SHA-256 of a dataset's files.
inline constexpr char kFrameHashesName[] = "frames.sha256";

/// Writes frames.sha256, which `sha256sum -c` can check: one line per file of a channel, sorted by
/// name. Returns the number of files. Throws InputError on failure.
std::int64_t WriteFrameHashes(const std::filesystem::path& dataset);

}  // namespace tera
