#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/config/config.h"
#include "core/time.h"
#include "dataset/format/epoch.h"
#include "dataset/import/clocks/clock_difference.h"

namespace tera {

/// Converts the stroke of a cylinder to the position of its joint. `least_m` and `most_m` are the
/// strokes at the limits of the joint.
struct CylinderStroke {
  std::function<double(double stroke_m)> position;
  double least_m = 0, most_m = 0;
};

struct ImportOptions {
  /// Texts key.path=value as in --set, most often `file=recording.csv`.
  std::vector<std::string> overrides = {};
  bool skips_bad_rows = false;  ///< skip and count unreadable rows
  bool checks_only = false;     ///< read everything, write nothing
  /// Returns the stroke function of a joint of the machine that the key `machine_model` names. A
  /// joint without a cylinder is a fault of `joint`. A callback is used because the recording
  /// format does not depend on machines.
  std::function<CylinderStroke(const ConfigMap& machine, const ConfigMap& joint)> cylinder_stroke;
};

/// Upper limit for the rate of any joint or track. A larger rate is probably in degrees, or a jump.
inline constexpr double kFastestJoint_radps = 20;

/// Result of importing one channel.
struct ImportedChannel {
  std::string path, file;
  std::int64_t rows = 0, left_out = 0;
  std::string first_fault;  ///< message about the first row that was left out
  TimeNs first_ns = 0, last_ns = 0;
  TimeNs interval_ns = 0;      ///< median interval; 0 for a single row
  TimeNs longest_gap_ns = 0;   ///< between consecutive rows
  std::int64_t irregular = 0;  ///< number of intervals that differ from the median by more than
                               ///< half of it
  std::int64_t clamped_levers = 0, levers_beyond_full = 0;
  double largest_lever = 0;         ///< largest lever value beyond full deflection
  std::int64_t strokes_beyond = 0;  ///< number of strokes outside the joint limits
  double furthest_beyond_m = 0;
  std::int64_t too_fast = 0;  ///< number of rates above kFastestJoint_radps
  double fastest_radps = 0;   ///< largest rate
  std::string fastest_joint;
  std::vector<std::string> remarks;  ///< other warnings, and corrections that the mapping requests
};

struct ImportReport {
  std::vector<ImportedChannel> channels;
  TimeNs zero_ns = 0;  ///< time 0 of the recording, in the time of the files
  std::optional<RecordingEpoch> epoch;
  std::vector<ClockDifference> clocks;  ///< reported only; stamps are not corrected
};

}  // namespace tera
