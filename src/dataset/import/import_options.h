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

/// A joint's position as a function of a cylinder's stroke, and the strokes within the joint's
/// travel.
struct CylinderStroke {
  std::function<double(double stroke_m)> position;
  double least_m = 0, most_m = 0;
};

struct ImportOptions {
  /// key.path=value texts in --set's syntax, most often `file=recording.csv`.
  std::vector<std::string> overrides = {};
  bool skips_bad_rows = false;  ///< skips and counts unreadable rows
  bool checks_only = false;     ///< reads everything and writes nothing
  /// Returns the stroke function of a joint of the machine in the mapping's key `machine_model`. A
  /// joint without a cylinder is a fault of `joint`. This keeps the recording format independent of
  /// machines.
  std::function<CylinderStroke(const ConfigMap& machine, const ConfigMap& joint)> cylinder_stroke;
};

/// Upper limit of the rate of any joint or track. Larger rates are in degrees, or jumps.
inline constexpr double kFastestJoint_radps = 20;

/// Import result of one channel.
struct ImportedChannel {
  std::string path, file;
  std::int64_t rows = 0, left_out = 0;
  std::string first_fault;  ///< in the left out rows
  TimeNs first_ns = 0, last_ns = 0;
  TimeNs interval_ns = 0;      ///< median; 0 for a single row
  TimeNs longest_gap_ns = 0;   ///< between consecutive rows
  std::int64_t irregular = 0;  ///< intervals that differ from the median by more than half of it
  std::int64_t clamped_levers = 0, levers_beyond_full = 0;
  double largest_lever = 0;         ///< largest one beyond full
  std::int64_t strokes_beyond = 0;  ///< strokes outside the range of the joint's travel
  double furthest_beyond_m = 0;
  std::int64_t too_fast = 0;  ///< rates above kFastestJoint_radps
  double fastest_radps = 0;   ///< the largest of these
  std::string fastest_joint;
  std::vector<std::string> remarks;  ///< other suspected faults, and requested corrections
};

struct ImportReport {
  std::vector<ImportedChannel> channels;
  TimeNs zero_ns = 0;                   ///< the recording's zero in the files' times
  std::optional<RecordingEpoch> epoch;  ///< epoch of the recording
  std::vector<ClockDifference> clocks;  ///< reported, never corrected
};

}  // namespace tera
