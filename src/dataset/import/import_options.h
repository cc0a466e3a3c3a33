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

/// A joint's position from a cylinder's stroke, and the strokes that the joint's travel gives it.
struct CylinderStroke {
  std::function<double(double stroke_m)> position;
  double least_m = 0, most_m = 0;
};

struct ImportOptions {
  /// key.path=value texts as of --set, above all `file=recording.csv`.
  std::vector<std::string> overrides = {};
  bool skips_bad_rows = false;  ///< leaves out rows that cannot be read, and counts them
  bool checks_only = false;     ///< reads all and writes nothing
  /// Gives it for a joint of the machine that the mapping's key `machine_model` describes; a fault
  /// of `joint` where no cylinder moves it. The format of recordings itself knows no machines.
  std::function<CylinderStroke(const ConfigMap& machine, const ConfigMap& joint)> cylinder_stroke;
};

/// No joint or track of a machine turns faster: what does is in degrees, or jumps.
inline constexpr double kFastestJoint_radps = 20;

/// What came of one channel.
struct ImportedChannel {
  std::string path, file;
  std::int64_t rows = 0, left_out = 0;
  std::string first_fault;  ///< of the rows left out
  TimeNs first_ns = 0, last_ns = 0;
  TimeNs interval_ns = 0;      ///< the median one; 0 of a single row
  TimeNs longest_gap_ns = 0;   ///< from a row to the next
  std::int64_t irregular = 0;  ///< intervals that differ from the median by more than half of it
  std::int64_t clamped_levers = 0, levers_beyond_full = 0;
  double largest_lever = 0;         ///< of those beyond full
  std::int64_t strokes_beyond = 0;  ///< what the joint's travel gives its cylinder
  double furthest_beyond_m = 0;
  std::int64_t too_fast = 0;  ///< rates of joints that no machine's joint has
  double fastest_radps = 0;   ///< of these
  std::string fastest_joint;
  std::vector<std::string> remarks;  ///< on what else may be wrong, or was put right as asked for
};

struct ImportReport {
  std::vector<ImportedChannel> channels;
  TimeNs zero_ns = 0;                   ///< of the recording, in the files' times
  std::optional<RecordingEpoch> epoch;  ///< of the recording
  std::vector<ClockDifference> clocks;  ///< told, and never put right
};

}  // namespace tera
