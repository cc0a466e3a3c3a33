#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/config/config.h"
#include "core/time.h"

namespace tera {

/// The time scale that a clock counts in.
enum class ClockScale {
  kUtc,     ///< Unix time: UTC without leap seconds
  kGps,     ///< GPS time, as a date: ahead of UTC by the leap seconds since 1980
  kUnknown  ///< some clock that counts from 1970
};

/// When the times of a recording are 0, exact to the nanosecond.
struct RecordingEpoch {
  TimeNs since_1970_ns = 0;  ///< by `clock`
  ClockScale clock = ClockScale::kUnknown;

  bool operator==(const RecordingEpoch&) const = default;
};

/// "UTC", "GPS time" or "a clock that is not known".
std::string_view TextOf(ClockScale clock);

/// The epoch as the line `epoch: {...}` of dataset.yaml.
std::string EpochYaml(const RecordingEpoch& epoch);

/// The key `epoch` of dataset.yaml or of a mapping, where it is there. In a mapping, whose files
/// may count from 1970 themselves, `since_1970_ns` may be left out for 0. Faults go to `config`.
std::optional<RecordingEpoch> ReadEpoch(const ConfigMap& config, bool may_count_from_1970 = false);

/// By how much GPS time was ahead of UTC at a GPS time, since 1999.
///
/// Source  IERS Bulletin C; the last leap second was at the end of 2016.
TimeNs GpsAheadOfUtc(TimeNs gps_ns);

/// The epoch by UTC; one of a clock that is not known is taken for that.
TimeNs UtcOf(const RecordingEpoch& epoch);

/// By how much the zero of `b` is later than that of `a`: by UTC where both clocks are known, else
/// as if they were one.
TimeNs ZeroOfAfter(const RecordingEpoch& a, const RecordingEpoch& b);

}  // namespace tera
